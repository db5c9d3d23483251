#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "build_state.hpp"
#include "limits.hpp"
#include "linewright/scenario/values.hpp"

namespace linewright::loading {
namespace {

/// Where all workers or carriers of one kind start.
struct StartRule {
  Section section;
  std::int32_t id;
  WorkerKindId poses_of;  ///< the kind whose poses count
  const std::vector<StationId>& list;
  CountRange count;
};

void check_list(const BuildState& state, const StartRule& rule) {
  const SourceNode& start = *state.names.node(rule.section, rule.id).find("start");
  const std::string title = state.names.title(rule.section, rule.id);
  const std::string& kind = state.line().worker_kinds[rule.poses_of.index()].name;
  for (std::size_t i = 0; i < rule.list.size(); ++i) {
    const Station& station = state.line().stations[rule.list[i].index()];
    if (station.poses[rule.poses_of.index()]) continue;
    state.problems.error(start.items[i].mark,
                         fmt::format("{}: start station {} has no pose for {}", title,
                                     in_quotes(station.name), in_quotes(kind)),
                         fmt::format("give the station {}: [x_m, y_m, yaw_rad]", kind));
  }
  if (rule.list.size() >= static_cast<std::size_t>(rule.count.max)) return;
  state.problems.error(
      start.mark,
      fmt::format("{}: {} start stations for up to {}", title, rule.list.size(), rule.count.max),
      "list one station for each, or write start: random_station");
}

void check_random(const BuildState& state, const StartRule& rule) {
  std::int64_t slots = 0;
  for (const Station& station : state.line().stations) {
    if (station.poses[rule.poses_of.index()]) {
      slots += station.slots[rule.poses_of.index()];
    }
  }
  if (slots >= rule.count.max) return;
  const std::string& kind = state.line().worker_kinds[rule.poses_of.index()].name;
  state.problems.error(
      state.names.mark(rule.section, rule.id),
      fmt::format("{}: {} start slots at stations with a pose for {}, but there are up to {}",
                  state.names.title(rule.section, rule.id), slots, in_quotes(kind), rule.count.max),
      fmt::format("give more stations a pose for {}, or write slots: {{{}: N}}", in_quotes(kind),
                  kind));
}

void check_start(const BuildState& state, const StartRule& rule) {
  if (!state.is_sound(rule.section, rule.id)) return;
  if (rule.list.empty()) {
    check_random(state, rule);
  } else {
    check_list(state, rule);
  }
}

/// Where a kind rests it must have a pose.
void check_rest(const BuildState& state, std::int32_t id, const WorkerKind& kind) {
  if (kind.rest.empty() || !state.is_sound(Section::kWorkers, id)) return;
  const SourceNode& rest = *state.names.node(Section::kWorkers, id).find("rest");
  for (std::size_t i = 0; i < kind.rest.size(); ++i) {
    const Station& station = state.line().stations[kind.rest[i].index()];
    if (station.poses[static_cast<std::size_t>(id)]) continue;
    state.problems.error(rest.is_list() ? rest.items[i].mark : rest.mark,
                         fmt::format("{}: it rests at station {}, which has no pose for {}",
                                     state.names.title(Section::kWorkers, id),
                                     in_quotes(station.name), in_quotes(kind.name)),
                         fmt::format("give the station {}: [x_m, y_m, yaw_rad]", kind.name));
  }
}

}  // namespace

void check_workers(const BuildState& state) {
  if (!state.all_sound(Section::kStations)) return;  // a pose may be missing because it was wrong
  const LineModel& line = state.line();
  for (std::size_t i = 0; i < line.worker_kinds.size(); ++i) {
    const auto id = static_cast<std::int32_t>(i);
    const WorkerKind& kind = line.worker_kinds[i];
    check_start(state, {Section::kWorkers, id, WorkerKindId(id), kind.start, kind.count});
    check_rest(state, id, kind);
  }
  for (std::size_t i = 0; i < line.carrier_kinds.size(); ++i) {
    const auto id = static_cast<std::int32_t>(i);
    const CarrierKind& kind = line.carrier_kinds[i];
    check_start(state, {Section::kCarriers, id, kind.moved_by, kind.start, kind.count});
  }
}

void check_places(const BuildState& state) {
  const LineModel& line = state.line();
  for (std::size_t i = 0; i < line.places.size(); ++i) {
    const auto id = static_cast<std::int32_t>(i);
    const Place& place = line.places[i];
    if (!state.is_sound(Section::kPlaces, id)) continue;
    const std::int64_t initial = place.initial.value(line.order.quantity);
    const std::int32_t most = place.capacity.value_or(kLargestAmount);
    if (initial <= most) continue;
    state.problems.error(
        mark_of(state.names.node(Section::kPlaces, id), "initial"),
        fmt::format("{}: {} tokens at the start, but {} {}",
                    state.names.title(Section::kPlaces, id), initial,
                    place.capacity ? "its capacity is" : "a place holds at most", most),
        "make 'capacity' larger or 'initial' smaller");
  }
}

}  // namespace linewright::loading
