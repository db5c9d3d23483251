#include "route_requests.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "linewright/scenario/values.hpp"

namespace linewright::loading {
namespace {

Footprint footprint_of(const WorkerKind& worker) {
  if (worker.footprint_m.size() == 2) {
    return Footprint::rectangle(worker.footprint_m[0], worker.footprint_m[1]);
  }
  if (!worker.outline_m.empty()) return Footprint::polygon(worker.outline_m);
  return Footprint::circle(worker.radius_m);
}

PathPlannerOptions options_of(const BuildState& state) {
  PathPlannerOptions options;
  const SourceNode* node = state.root.find("routes");
  if (node == nullptr) return options;
  options.clearance_m = real_or(*node, "clearance_m", options.clearance_m);
  options.headings = integer_or(*node, "headings", options.headings);
  options.reverse_penalty = real_or(*node, "reverse_penalty", options.reverse_penalty);
  options.direction_change_m = real_or(*node, "direction_change_m", options.direction_change_m);
  options.steering_change_m = real_or(*node, "steering_change_m", options.steering_change_m);
  options.turn_m_per_rad = real_or(*node, "turn_m_per_rad", options.turn_m_per_rad);
  options.greed = real_or(*node, "greed", options.greed);
  options.smoothing_passes = integer_or(*node, "smoothing_passes", options.smoothing_passes);
  options.most_expansions = static_cast<std::size_t>(
      integer_or(*node, "most_expansions", static_cast<std::int32_t>(options.most_expansions)));
  return options;
}

/// From a point inside to the nearest side.
double distance_to_edge_m(const Rectangle& r, Point2 p) {
  return std::min({p.x_m - r.x0_m, r.x1_m - p.x_m, p.y_m - r.y0_m, r.y1_m - p.y_m});
}

/// "obstacle 'table'", the one nearest to the point, the map's file, or the edge.
std::string culprit(const HallMap& map, Point2 point) {
  const bool outside = !contains(corners_of(map.bounds), point);
  if (outside) return "the edge of the map, beyond which the station lies";
  const Obstacle* nearest = nullptr;
  double nearest_m = distance_to_edge_m(map.bounds, point);
  for (const Obstacle& obstacle : map.obstacles) {
    const double metres = distance_to_m(point, obstacle.polygon);
    if (metres >= nearest_m) continue;
    nearest = &obstacle;
    nearest_m = metres;
  }
  if (nearest != nullptr) return "obstacle " + in_quotes(nearest->name);
  return map.occupancy.empty() ? "the edge of the map" : "the map " + in_quotes(map.occupancy);
}

std::string body_of(const WorkerKind& worker) {
  if (worker.footprint_m.size() == 2) {
    return fmt::format("footprint {} m x {} m", worker.footprint_m[0], worker.footprint_m[1]);
  }
  if (!worker.outline_m.empty()) return "its outline";
  return fmt::format("radius {} m", worker.radius_m);
}

bool check_size(BuildState& state, const RoutedKind& routed, const KindRoutes& kind) {
  const Rectangle& hall = state.scenario.map->bounds;
  const double narrow_m = std::min(hall.x1_m - hall.x0_m, hall.y1_m - hall.y0_m);
  if (2.0 * kind.request.mover.footprint.inscribed_m() < narrow_m) return true;
  state.problems.error(routed.mark,
                       fmt::format("worker {} ({}) is larger than the hall, which is {:.2f} m wide",
                                   in_quotes(kind.request.kind),
                                   body_of(state.line().worker_kinds[routed.kind]), narrow_m),
                       "lengths are metres: check 'footprint_m', 'radius_m' and the map");
  return false;
}

bool check_stop(BuildState& state, const KindRoutes& kind, std::size_t stop,
                const CollisionChecker& checker, const RoutedKind& routed) {
  const Pose2& pose = kind.request.stops[stop].pose;
  if (checker.free(checker.map().frame().to_grid(pose))) return true;
  state.problems.error(
      state.names.mark(Section::kStations, kind.stations[stop].value),
      fmt::format("station {}: {} ({}) cannot stand at ({}, {}) because of {}",
                  in_quotes(kind.request.stops[stop].name), in_quotes(kind.request.kind),
                  body_of(state.line().worker_kinds[routed.kind]), pose.x_m, pose.y_m,
                  culprit(*state.scenario.map, pose.point())),
      fmt::format("move the pose so that the footprint and {} m around it are free",
                  kind.request.options.clearance_m));
  return false;
}

/// Two stations of one kind at one place are one station with two names: a worker at the one would
/// have to drive to the other.
bool check_distinct(BuildState& state, const KindRoutes& kind) {
  constexpr double kOnePlace_m = 1e-3;
  bool distinct = true;
  for (std::size_t i = 0; i < kind.stations.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Pose2& a = kind.request.stops[i].pose;
      if (distance_m(a.point(), kind.request.stops[j].pose.point()) > kOnePlace_m) continue;
      distinct = false;
      state.problems.error(
          state.names.mark(Section::kStations, kind.stations[i].value),
          fmt::format("stations {} and {} are at one place for {}: ({}, {})",
                      in_quotes(kind.request.stops[j].name), in_quotes(kind.request.stops[i].name),
                      in_quotes(kind.request.kind), a.x_m, a.y_m),
          "move one of them, or use one station with slots");
    }
  }
  return distinct;
}

}  // namespace

KindRoutes route_request(const BuildState& state, const RoutedKind& routed) {
  const LineModel& line = state.line();
  const WorkerKind& worker = line.worker_kinds[routed.kind];
  KindRoutes kind;
  kind.request = {.kind = worker.name,
                  .planner = routed.planner,
                  .mover = {footprint_of(worker), worker.turning_radius_m},
                  .options = options_of(state)};
  kind.motion = {worker.speed_mps, worker.turn_rate_radps, worker.acceleration_mps2};
  for (std::size_t i = 0; i < line.stations.size(); ++i) {
    const auto& pose = line.stations[i].poses[routed.kind];
    if (!pose) continue;
    kind.stations.emplace_back(i);
    kind.request.stops.push_back({line.stations[i].name, *pose});
  }
  return kind;
}

bool check_stops(BuildState& state, const KindRoutes& kind, const RoutedKind& routed,
                 const std::shared_ptr<const ClearanceMap>& map) {
  if (!check_size(state, routed, kind)) return false;
  const bool distinct = check_distinct(state, kind);
  // Plain planners go with the disc around the footprint.
  const Footprint& body = kind.request.mover.footprint;
  const bool plain = kind.request.planner != "hybrid_a_star";
  const CollisionChecker checker(map, (plain ? Footprint::circle(body.circumscribed_m()) : body)
                                          .grown(kind.request.options.clearance_m));
  bool all_free = true;
  for (std::size_t stop = 0; stop < kind.stations.size(); ++stop) {
    all_free = check_stop(state, kind, stop, checker, routed) && all_free;
  }
  return distinct && all_free;
}

}  // namespace linewright::loading
