#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "linewright/base/cancel.hpp"
#include "linewright/base/geometry.hpp"
#include "linewright/map/collision_checker.hpp"
#include "linewright/routing/path.hpp"
#include "linewright/routing/reeds_shepp.hpp"

namespace linewright {

/// A body that moves: what every planner has to know about a kind of worker.
struct Mover {
  Footprint footprint = Footprint::circle(0.3);
  double turning_radius_m = 0.0;  ///< 0: turns on the spot
};

/// How paths are searched. The defaults suit halls of up to a few hundred metres; each field says
/// when to change it and what that costs.
struct PathPlannerOptions {
  /// Kept free around the footprint beside the exact check, metres, 0.001 ... 0.5. Smaller than
  /// half a millimetre and arcs may graze a corner between two looks.
  double clearance_m = 0.01;
  /// Steps of a full turn, 16 ... 180. Arcs turn a divisor of them that takes half a cell at least;
  /// numbers with many divisors (72, 96, 144) leave the finest choice. More: larger tables.
  int headings = 72;
  /// Factor on metres driven backwards, 1 ... 5. 1: backwards is as good as forwards.
  double reverse_penalty = 1.05;
  /// Metres that each change of direction counts, 0 ... 5. More: fewer shunting moves, longer ways.
  double direction_change_m = 0.1;
  /// Metres that each change between straight and arc counts, 0 ... 1. More: calmer steering.
  double steering_change_m = 0.02;
  /// Metres that a radian turned on the spot counts, 0 ... 5; for polygons with turning radius 0.
  double turn_m_per_rad = 0.1;
  /// Factor on the estimate of what is left, 1 ... 3. More: faster, and longer ways by at most
  /// that before they are smoothed.
  double greed = 1.1;
  /// Passes of smoothing, 0 ... 10.
  int smoothing_passes = 3;
  /// Nodes after which a search gives up (kSearchLimit). Memory goes with the cells that are
  /// reached: up to 16 bytes times `headings` each, 2 GB at most.
  std::size_t most_expansions = 3'000'000;
  /// Looked at now and then: once requested, searches end with kSearchLimit. Changes no result.
  const CancelToken* cancel = nullptr;
};

/// What the last search took.
struct SearchEffort {
  std::size_t expansions = 0;
  std::size_t connections = 0;  ///< curves to the goal that were tried
};

/// Finds paths of one mover on one map. Not thread-safe: one planner per thread; the map is shared.
class PathPlanner {
 public:
  virtual ~PathPlanner() = default;

  /// A path between two poses in the frame `map`. The mover keeps off blocked cells everywhere on
  /// it, curvature stays within its turning radius, and both ends are met exactly (but for
  /// rounding); a circle that turns on the spot arrives with any heading and then turns. The same
  /// arguments give the same path whatever was asked before. Equal goals one after the other are
  /// cheaper.
  [[nodiscard]] virtual Path plan(const Pose2& start, const Pose2& goal) = 0;

  [[nodiscard]] virtual SearchEffort effort() const = 0;
};

/// "hybrid_a_star", "a_star", "dijkstra".
[[nodiscard]] const std::vector<std::string>& path_planner_names();

/// Throws ScenarioError naming the nearest known planner when `name` is none. The last two are
/// plain searches on the grid for the disc around the mover, which is taken to turn on the spot.
[[nodiscard]] std::unique_ptr<PathPlanner> make_path_planner(
    std::string_view name, std::shared_ptr<const ClearanceMap> map, const Mover& mover,
    const PathPlannerOptions& options = {});

}  // namespace linewright
