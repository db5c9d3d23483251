#include "travel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "build_state.hpp"
#include "linewright/routing/path_planner.hpp"
#include "linewright/scenario/values.hpp"
#include "needed_ways.hpp"

namespace linewright::loading {
namespace {

bool has_pose(const BuildState& state, std::size_t station, std::size_t kind) {
  return state.line().stations[station].poses[kind].has_value();
}

Point2 point_of(const BuildState& state, std::size_t station, std::size_t kind) {
  return state.line().stations[station].poses[kind]->point();
}

void fill_straight(BuildState& state, std::size_t kind, SourceMark mark) {
  TravelTable& table = state.line().travel[kind];
  const std::size_t count = state.line().stations.size();
  for (std::size_t from = 0; from < count; ++from) {
    for (std::size_t to = 0; to < count; ++to) {
      if (from == to || !has_pose(state, from, kind) || !has_pose(state, to, kind)) continue;
      const double metres = distance_m(point_of(state, from, kind), point_of(state, to, kind));
      const auto ticks = ticks_for(state, kind, metres, mark);
      if (!ticks) return;
      table.set(StationId(from), StationId(to), {*ticks, metres});
    }
  }
}

/// Reads one measured table.
class TableReader {
 public:
  TableReader(BuildState& state, std::size_t kind, const SourceNode& node)
      : state_(state),
        kind_(kind),
        node_(node),
        title_(fmt::format("travel of {}", in_quotes(state.line().worker_kinds[kind].name))) {}

  void read() {
    for (const SourceEntry& row : node_.entries) {
      const auto from = station(row);
      for (const SourceEntry& cell : row.value.entries) {
        const auto to = station(cell);
        if (from && to) set_leg(*from, *to, cell);
      }
    }
  }

 private:
  std::optional<std::size_t> station(const SourceEntry& entry) {
    const auto id = reference(state_, Section::kStations, entry.key, entry.mark, title_);
    if (!id) return std::nullopt;
    const auto index = static_cast<std::size_t>(*id);
    if (has_pose(state_, index, kind_)) return index;
    const std::string& kind = state_.line().worker_kinds[kind_].name;
    state_.problems.error(
        entry.mark, fmt::format("{}: station {} has no pose for it", title_, in_quotes(entry.key)),
        fmt::format("give the station {}: [x_m, y_m, yaw_rad], or remove the way", kind));
    return std::nullopt;
  }

  void set_leg(std::size_t from, std::size_t to, const SourceEntry& cell) {
    if (cell.value.is_broken()) return;
    if (from == to) {
      state_.problems.error(cell.mark,
                            fmt::format("{}: a way from {} to itself", title_, in_quotes(cell.key)),
                            "remove it; staying takes no time (see min_leg_ticks)");
      return;
    }
    state_.line().travel[kind_].set(StationId(from), StationId(to), leg(from, to, cell));
  }

  Leg leg(std::size_t from, std::size_t to, const SourceEntry& cell) {
    const double straight = distance_m(point_of(state_, from, kind_), point_of(state_, to, kind_));
    if (cell.value.is_scalar()) {
      return {static_cast<Tick>(parse_integer(cell.value.text).value_or(0)), straight};
    }
    const auto ticks = parse_integer(cell.value.items[0].text);
    if (!ticks) {
      state_.problems.error(cell.value.mark,
                            fmt::format("{}: ticks must be a whole number, but are {}", title_,
                                        in_quotes(cell.value.items[0].text)),
                            "write [ticks, metres]");
    }
    return {static_cast<Tick>(ticks.value_or(0)),
            parse_real(cell.value.items[1].text).value_or(straight)};
  }

  BuildState& state_;
  std::size_t kind_;
  const SourceNode& node_;
  std::string title_;
};

/// Also when what was written is wrong.
bool is_written(const SourceNode& mapping, std::string_view key) {
  return std::any_of(mapping.entries.begin(), mapping.entries.end(),
                     [&](const SourceEntry& entry) { return entry.key == key; });
}

/// Fills the table of a kind, or notes that its routes are planned on the map.
void fill_kind(BuildState& state, std::size_t kind, const SourceNode* travel,
               std::vector<RoutedKind>& routed) {
  const std::string& name = state.line().worker_kinds[kind].name;
  const SourceNode* given = travel != nullptr ? travel->find(name) : nullptr;
  const SourceMark mark =
      given != nullptr ? given->mark
                       : state.names.mark(Section::kWorkers, static_cast<std::int32_t>(kind));
  if (given != nullptr && given->is_mapping()) return TableReader(state, kind, *given).read();
  const bool has_map = is_written(state.root, "map");
  const bool straight = given != nullptr ? given->text == "straight" : !has_map;
  if (straight) return fill_straight(state, kind, mark);
  if (state.scenario.map) {
    routed.push_back({kind, given != nullptr ? given->text : path_planner_names().front(), mark});
  } else if (!has_map) {  // else it was reported as wrong
    state.problems.error(
        mark, fmt::format("travel of {}: '{}' needs a map", in_quotes(name), given->text),
        "write map: {bounds: [x0, x1, y0, y1]}, or travel: straight");
  }
}

/// The stations of `to` that cannot be reached from `from`, as a list for a message; maybe empty.
std::string missing_from(const BuildState& state, std::size_t kind, StationId from,
                         const std::vector<StationId>& to) {
  constexpr std::size_t kMostNamed = 8;
  std::string list;
  std::size_t missing = 0;
  for (const StationId target : to) {
    if (target == from || state.line().travel[kind].leg(from, target).ticks >= 0) continue;
    if (++missing > kMostNamed) continue;
    list += (list.empty() ? "" : ", ") + in_quotes(state.line().stations[target.index()].name);
  }
  return missing > kMostNamed ? fmt::format("{} and {} more", list, missing - kMostNamed) : list;
}

std::string hint_for(PathStatus status) {
  switch (status) {
    case PathStatus::kNoManoeuvre:
      return "a smaller 'turning_radius_m' or footprint, a wider aisle, or a finer map";
    case PathStatus::kSearchLimit:
      return "raise 'most_expansions' in 'routes', or make 'cell_m' larger";
    default:
      return "make an aisle wider, the footprint smaller, or 'cell_m' finer";
  }
}

/// Reports every way on the map that a task can need and that was not found, and why.
void check_routes(const BuildState& state, std::size_t kind, SourceMark mark,
                  const NeededWays& ways) {
  const KindRoutes& routes = *state.scenario.routes[kind];
  const auto stop_of = [&](StationId station) {
    const auto found = std::find(routes.stations.begin(), routes.stations.end(), station);
    return static_cast<std::size_t>(found - routes.stations.begin());
  };
  for (const StationId from : ways.from) {
    for (const StationId to : ways.to) {
      if (from == to || state.line().travel[kind].leg(from, to).ticks >= 0) continue;
      const std::size_t a = stop_of(from);
      const std::size_t b = stop_of(to);
      const PathStatus status = routes.routes.path(a, b).status;
      if (status == PathStatus::kFound) {  // then it takes more ticks than there are
        state.problems.error(mark,
                             fmt::format("worker {} is too slow", in_quotes(routes.request.kind)),
                             "check speed_mps, turn_rate_radps, acceleration_mps2 and tick_s");
        return;
      }
      state.problems.error(mark,
                           fmt::format("travel of {}: {}", in_quotes(routes.request.kind),
                                       explain_missing(routes.request, a, b, status)),
                           hint_for(status));
    }
  }
}

void check_ways(const BuildState& state, std::size_t kind, const SourceNode* travel) {
  const std::string& worker = state.line().worker_kinds[kind].name;
  const SourceNode* given = travel != nullptr ? travel->find(worker) : nullptr;
  const bool measured = given != nullptr && given->is_mapping();
  const NeededWays ways = needed_ways(state.line(), WorkerKindId(kind));
  if (state.scenario.routes[kind]) {
    const SourceMark mark =
        given != nullptr ? given->mark
                         : state.names.mark(Section::kWorkers, static_cast<std::int32_t>(kind));
    return check_routes(state, kind, mark, ways);
  }
  for (const StationId from : ways.from) {
    const std::string missing = missing_from(state, kind, from, ways.to);
    if (missing.empty()) continue;
    const std::string& start = state.line().stations[from.index()].name;
    const SourceNode* row = measured ? given->find(start) : nullptr;
    SourceMark mark = given != nullptr
                          ? given->mark
                          : state.names.mark(Section::kWorkers, static_cast<std::int32_t>(kind));
    if (row != nullptr) mark = row->mark;
    state.problems.error(
        mark,
        fmt::format("travel of {}: a task can need a way from {} to {}, and there is none",
                    in_quotes(worker), in_quotes(start), missing),
        fmt::format("write {}: {{TO: ticks}} for each of them", start));
  }
}

void check_kinds(BuildState& state, const SourceNode& travel) {
  for (const SourceEntry& entry : travel.entries) {
    (void)reference(state, Section::kWorkers, entry.key, entry.mark, "travel");
  }
}

/// Zones ask for new ways at run time, which only a map has.
void check_zones(const BuildState& state) {
  if (state.line().zones.empty()) return;
  for (std::size_t kind = 0; kind < state.scenario.routes.size(); ++kind) {
    if (state.scenario.routes[kind]) continue;
    const std::string& name = state.line().worker_kinds[kind].name;
    state.problems.error(
        mark_of(state.root, "zones"),
        fmt::format("zones: the ways of {} do not come from a map, and ways through "
                    "a zone can only be planned anew on a map",
                    in_quotes(name)),
        fmt::format("write travel: {{{}: hybrid_a_star}}, or remove 'zones'", name));
  }
}

}  // namespace

std::optional<Tick> ticks_for(BuildState& state, std::size_t kind, double metres, SourceMark mark) {
  const WorkerKind& worker = state.line().worker_kinds[kind];
  // A way of exactly three ticks must not become four because of the last bit of a division.
  constexpr double kSlack = 1e-9;
  const double ticks = std::ceil(metres / (worker.speed_mps * state.line().tick_s) - kSlack);
  if (ticks <= static_cast<double>(kMaxTicks)) return static_cast<Tick>(std::max(0.0, ticks));
  state.problems.error(
      mark,
      fmt::format("worker {} is too slow: a way of {:.1f} m takes more than {} ticks",
                  in_quotes(worker.name), metres, kMaxTicks),
      "check speed_mps and tick_s");
  return std::nullopt;
}

void build_travel(BuildState& state) {
  const SourceNode* travel = state.root.find("travel");
  if (travel != nullptr) check_kinds(state, *travel);
  const std::size_t kinds = state.line().worker_kinds.size();
  state.line().travel.assign(kinds, TravelTable(state.line().stations.size()));
  state.scenario.routes.resize(kinds);
  std::vector<RoutedKind> routed;
  for (std::size_t kind = 0; kind < kinds; ++kind) fill_kind(state, kind, travel, routed);
  fill_from_routes(state, routed);
  if (!state.problems.none()) return;  // a way may be missing because of what was reported
  for (std::size_t kind = 0; kind < kinds; ++kind) check_ways(state, kind, travel);
  check_zones(state);
}

}  // namespace linewright::loading
