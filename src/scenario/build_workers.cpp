#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "areas.hpp"
#include "build_state.hpp"
#include "linewright/scenario/values.hpp"

namespace linewright::loading {
namespace {

CountRange count_range(BuildState& state, const SourceNode& node, const std::string& title) {
  const SourceNode* count = node.find("count");
  if (count == nullptr) return {};
  if (!count->is_list()) {
    const auto number = static_cast<std::int32_t>(parse_integer(count->text).value_or(1));
    return {number, number};
  }
  const auto bound = [&](std::size_t i) {
    return static_cast<std::int32_t>(parse_integer(count->items[i].text).value_or(0));
  };
  const CountRange range{bound(0), bound(1)};
  if (range.min > range.max) {
    state.problems.error(
        count->mark,
        fmt::format("{}: 'count' goes from {} down to {}", title, range.min, range.max),
        fmt::format("write [{}, {}]", range.max, range.min));
    return {};
  }
  return range;
}

std::vector<StationId> start_stations(BuildState& state, const SourceNode& node,
                                      const std::string& title) {
  std::vector<StationId> stations;
  const SourceNode* start = node.find("start");
  if (start == nullptr || !start->is_list()) return stations;
  if (start->items.empty()) {
    state.problems.error(start->mark, fmt::format("{}: 'start' is an empty list", title),
                         "write random_station, or one station for each");
  }
  for (const SourceNode& item : start->items) {
    if (const auto id = reference(state, Section::kStations, item, title))
      stations.emplace_back(*id);
  }
  return stations;
}

/// Where a kind of worker rests; `rest` is one station or a list.
void read_rest(BuildState& state, const SourceNode& node, const std::string& title,
               WorkerKind& kind) {
  kind.rest_after = integer_or(node, "rest_after", kind.rest_after);
  const SourceNode* rest = node.find("rest");
  if (rest == nullptr) {
    if (node.find("rest_after") == nullptr) return;
    state.problems.error(mark_of(node, "rest_after"),
                         fmt::format("{}: 'rest_after' without a place to rest", title),
                         "write rest: STATION, or remove it");
    return;
  }
  const auto add = [&](const SourceNode& item) {
    if (const auto id = reference(state, Section::kStations, item, title)) {
      kind.rest.emplace_back(*id);
    }
  };
  if (rest->is_scalar()) add(*rest);
  for (const SourceNode& item : rest->items) add(item);
}

void build_worker(BuildState& state, std::int32_t id, const SourceNode& node) {
  const std::string title = state.names.title(Section::kWorkers, id);
  WorkerKind kind;
  kind.name = state.names.names(Section::kWorkers)[static_cast<std::size_t>(id)];
  kind.count = count_range(state, node, title);
  kind.speed_mps = real_or(node, "speed_mps", kind.speed_mps);
  kind.radius_m = real_or(node, "radius_m", kind.radius_m);
  kind.turning_radius_m = real_or(node, "turning_radius_m", kind.turning_radius_m);
  kind.turn_rate_radps = real_or(node, "turn_rate_radps", kind.turn_rate_radps);
  kind.acceleration_mps2 = real_or(node, "acceleration_mps2", kind.acceleration_mps2);
  kind.min_leg_ticks = integer_or(node, "min_leg_ticks", kind.min_leg_ticks);
  if (const SourceNode* outline = node.find("outline_m")) {
    kind.outline_m = read_polygon(state, *outline, title).value_or(Polygon{});
    if (!kind.outline_m.empty() && !contains(kind.outline_m, {})) {
      state.problems.error(
          outline->mark, fmt::format("{}: its outline does not lie around its pose [0, 0]", title),
          "give the corners as seen from the point that stations name");
    }
    if (node.find("footprint_m") != nullptr) {
      state.problems.error(outline->mark,
                           fmt::format("{}: it has both 'footprint_m' and 'outline_m'", title),
                           "remove one of them");
    }
  }
  if (const SourceNode* footprint = node.find("footprint_m")) {
    for (const SourceNode& item : footprint->items) {
      kind.footprint_m.push_back(parse_real(item.text).value_or(0.0));
    }
  }
  kind.start = start_stations(state, node, title);
  read_rest(state, node, title, kind);
  state.line().worker_kinds.push_back(std::move(kind));
}

/// `count` is the name of a worker kind: as many carriers as there are of these.
void count_as_worker(BuildState& state, const SourceNode& count, const std::string& title,
                     CarrierKind& kind) {
  const auto id = reference(state, Section::kWorkers, count, title);
  if (!id) return;
  kind.count_as = WorkerKindId(*id);
  kind.count = state.line().worker_kinds[static_cast<std::size_t>(*id)].count;
}

void build_carrier(BuildState& state, std::int32_t id, const SourceNode& node) {
  const std::string title = state.names.title(Section::kCarriers, id);
  CarrierKind kind;
  kind.name = state.names.names(Section::kCarriers)[static_cast<std::size_t>(id)];
  const SourceNode* count = node.find("count");
  if (count != nullptr && count->is_scalar() && !parse_integer(count->text)) {
    count_as_worker(state, *count, title, kind);
  } else {
    kind.count = count_range(state, node, title);
  }
  kind.capacity = integer_or(node, "capacity", kind.capacity);
  const auto mover = reference_at<WorkerKindId>(state, Section::kWorkers, node, "moved_by", title);
  kind.moved_by = mover.value_or(WorkerKindId{});
  kind.start = start_stations(state, node, title);
  state.line().carrier_kinds.push_back(std::move(kind));
}

Pose2 pose_of(const SourceNode& node) {
  const auto number = [&](std::size_t i) { return parse_real(node.items[i].text).value_or(0.0); };
  return {number(0), number(1), number(2)};
}

void build_slots(BuildState& state, const SourceNode& slots, const std::string& title,
                 Station& station) {
  for (const SourceEntry& entry : slots.entries) {
    const auto kind = reference(state, Section::kWorkers, entry.key, entry.mark, title);
    if (!kind || entry.value.is_broken()) continue;
    const auto index = static_cast<std::size_t>(*kind);
    if (!station.poses[index]) {
      state.problems.error(
          entry.mark,
          fmt::format("{}: slots for {} without a pose for it", title, in_quotes(entry.key)),
          fmt::format("write {}: [x_m, y_m, yaw_rad]", entry.key));
      continue;
    }
    station.slots[index] = integer_or(slots, entry.key, 1);
  }
}

void build_station(BuildState& state, std::int32_t id, const SourceNode& node) {
  const std::string title = state.names.title(Section::kStations, id);
  Station station;
  station.name = state.names.names(Section::kStations)[static_cast<std::size_t>(id)];
  station.poses.resize(state.line().worker_kinds.size());
  station.slots.assign(state.line().worker_kinds.size(), 1);
  for (const SourceEntry& entry : node.entries) {
    if (entry.key == "slots") continue;
    const auto kind = reference(state, Section::kWorkers, entry.key, entry.mark, title);
    if (kind && entry.value.is_list()) {
      station.poses[static_cast<std::size_t>(*kind)] = pose_of(entry.value);
    }
  }
  if (const SourceNode* slots = node.find("slots")) build_slots(state, *slots, title, station);
  state.line().stations.push_back(std::move(station));
}

}  // namespace

void build_workers(BuildState& state) {
  state.each(Section::kWorkers,
             [&](std::int32_t id, const SourceNode& node) { build_worker(state, id, node); });
  state.each(Section::kCarriers,
             [&](std::int32_t id, const SourceNode& node) { build_carrier(state, id, node); });
}

void build_stations(BuildState& state) {
  state.each(Section::kStations,
             [&](std::int32_t id, const SourceNode& node) { build_station(state, id, node); });
}

}  // namespace linewright::loading
