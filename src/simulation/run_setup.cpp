#include "linewright/simulation/run_setup.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "linewright/base/diagnostic.hpp"

namespace linewright {
namespace {

constexpr std::int32_t kMostProducts = 1'000'000;

std::int32_t crew_size(const LineModel& line, const RunOptions& options, std::size_t kind,
                       std::uint64_t seed) {
  const WorkerKind& worker = line.worker_kinds[kind];
  if (kind < options.workers.size() && options.workers[kind]) {
    const std::int32_t asked = *options.workers[kind];
    if (asked < worker.count.min || asked > worker.count.max) {
      throw ScenarioError(
          {},
          fmt::format("{} {}s asked for, but line '{}' is made for {} to {}", asked, worker.name,
                      line.name, worker.count.min, worker.count.max),
          fmt::format("ask for {} to {}, or change workers.{}.count in the scenario",
                      worker.count.min, worker.count.max, worker.name));
    }
    return asked;
  }
  auto stream = RandomStream::derive(seed, "crew", kind);
  return stream.between(worker.count.min, worker.count.max);
}

/// States number them in 16 bits.
void refuse_too_many(const std::vector<std::vector<StationId>>& start, const char* what) {
  constexpr std::size_t kMost = 30'000;
  std::size_t total = 0;
  for (const auto& kind : start) total += kind.size();
  if (total <= kMost) return;
  throw ScenarioError({}, fmt::format("{} {} are too many for one run", total, what),
                      fmt::format("at most {} are possible", kMost));
}

/// By station: how many workers of the kind may start there.
std::vector<std::size_t> start_slots(const LineModel& line, WorkerKindId kind) {
  std::vector<std::size_t> slots;
  for (const Station& station : line.stations) {
    const std::int32_t many = station.poses[kind.index()] ? station.slots[kind.index()] : 0;
    slots.push_back(static_cast<std::size_t>(many));
  }
  return slots;
}

/// Draws `count` of the slots without replacement, each as likely; their stations in order of
/// drawing.
std::vector<StationId> draw(std::vector<std::size_t> slots, std::int32_t count,
                            RandomStream stream) {
  std::size_t left = std::accumulate(slots.begin(), slots.end(), std::size_t{0});
  std::vector<StationId> drawn;
  for (std::int32_t i = 0; i < count && left > 0; ++i, --left) {
    std::size_t pick = stream.below(left);
    std::size_t station = 0;
    while (pick >= slots[station]) pick -= slots[station++];
    --slots[station];
    drawn.emplace_back(station);
  }
  return drawn;
}

std::vector<StationId> place(const LineModel& line, WorkerKindId kind,
                             const std::vector<StationId>& fixed, std::int32_t count,
                             RandomStream stream) {
  if (fixed.empty()) return draw(start_slots(line, kind), count, stream);
  return {fixed.begin(), fixed.begin() + count};
}

void check_closures(const LineModel& line, const std::vector<Closure>& closures) {
  for (const Closure& closure : closures) {
    if (closure.zone < 0 || static_cast<std::size_t>(closure.zone) >= line.zones.size()) {
      throw ScenarioError({}, fmt::format("line '{}' has no zone {}", line.name, closure.zone),
                          fmt::format("it has {} zones", line.zones.size()));
    }
    if (closure.first < 1 || closure.first > kMaxTicks || closure.open <= closure.first ||
        closure.open > 2 * kMaxTicks) {
      throw ScenarioError(
          {},
          fmt::format("zone '{}' cannot be closed from tick {} to tick {}",
                      line.zones[static_cast<std::size_t>(closure.zone)].name, closure.first,
                      closure.open),
          fmt::format("close it from a tick up to {} on, for 1 tick or more", kMaxTicks));
    }
  }
}

}  // namespace

std::vector<Closure> joined_closures(std::vector<Closure> closures) {
  std::sort(closures.begin(), closures.end());
  std::vector<Closure> joined;
  for (const Closure& closure : closures) {
    if (!joined.empty() && joined.back().zone == closure.zone &&
        closure.first <= joined.back().open) {
      joined.back().open = std::max(joined.back().open, closure.open);
    } else {
      joined.push_back(closure);
    }
  }
  return joined;
}

std::vector<Closure> all_closures(const LineModel& line, std::vector<Closure> more) {
  for (std::size_t z = 0; z < line.zones.size(); ++z) {
    for (const auto& [first, open] : line.zones[z].closed) {
      more.push_back({static_cast<std::int32_t>(z), first, open});
    }
  }
  return joined_closures(std::move(more));
}

void check_setup(const LineModel& line, const RunSetup& setup) {
  if (setup.order < 1 || setup.order > kMostProducts) {
    throw ScenarioError({}, fmt::format("an order of {} is not possible", setup.order),
                        fmt::format("order 1 to {}", kMostProducts));
  }
  constexpr std::int64_t kMostItems = 100'000'000;
  for (const Place& p : line.places) {
    const std::int64_t items = p.initial.value(setup.order);
    const std::int64_t most = p.capacity.value_or(kMostItems);
    if (items > most) {
      throw ScenarioError({},
                          fmt::format("an order of {} puts {} items into '{}', which holds {}",
                                      setup.order, items, p.name, most),
                          "order less, or raise the capacity in the scenario");
    }
  }
  if (setup.horizon < 1 || setup.horizon > kMaxTicks) {
    throw ScenarioError({}, fmt::format("a horizon of {} ticks is not possible", setup.horizon),
                        fmt::format("give 1 to {} ticks", kMaxTicks));
  }
  refuse_too_many(setup.worker_start, "workers");
  refuse_too_many(setup.carrier_start, "carriers");
  check_closures(line, setup.closures);
}

RunSetup sample_setup(const LineModel& line, const RunOptions& options, std::uint64_t seed) {
  RunSetup setup;
  setup.order = options.order.value_or(line.order.quantity);
  setup.horizon = options.horizon.value_or(line.horizon.ticks(setup.order));
  for (std::size_t k = 0; k < line.worker_kinds.size(); ++k) {
    setup.worker_start.push_back(place(line, WorkerKindId(k), line.worker_kinds[k].start,
                                       crew_size(line, options, k, seed),
                                       RandomStream::derive(seed, "worker_start", k)));
  }
  for (std::size_t k = 0; k < line.carrier_kinds.size(); ++k) {
    const CarrierKind& carrier = line.carrier_kinds[k];
    const std::int32_t count =
        carrier.count_as
            ? static_cast<std::int32_t>(setup.worker_start[carrier.count_as->index()].size())
            : RandomStream::derive(seed, "carriers", k)
                  .between(carrier.count.min, carrier.count.max);
    setup.carrier_start.push_back(place(line, carrier.moved_by, carrier.start, count,
                                        RandomStream::derive(seed, "carrier_start", k)));
  }
  check_closures(line, options.closures);
  setup.closures = all_closures(line, options.closures);
  check_setup(line, setup);
  return setup;
}

}  // namespace linewright
