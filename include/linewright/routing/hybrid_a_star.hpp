#pragma once

#include <memory>

#include "linewright/routing/goal_distance.hpp"
#include "linewright/routing/path_planner.hpp"

namespace linewright {

/// Hybrid A* (D. Dolgov, S. Thrun, M. Montemerlo, J. Diebel: Path planning for autonomous vehicles
/// in unknown semi-structured environments, 2010): A* over cells and headings that keeps the exact
/// pose in each node, moves by motion primitives forwards and backwards, and connects to the goal
/// by the cheapest Reeds-Shepp curve (turning radius 0: by turning, going straight and turning).
/// Estimate of what is left: the larger of the Reeds-Shepp length without obstacles and
/// GoalDistance. What it finds is smoothed by shortcuts that are curves of the same kinds.
///
/// Primitives are exact arcs whose turn is a whole number of heading steps, so all headings of a
/// search differ from the start's by whole steps and no path is bent to fit a grid.
class HybridAStar final : public PathPlanner {
 public:
  HybridAStar(std::shared_ptr<const ClearanceMap> map, const Mover& mover,
              const PathPlannerOptions& options = {});
  ~HybridAStar() override;

  [[nodiscard]] Path plan(const Pose2& start, const Pose2& goal) override;
  [[nodiscard]] SearchEffort effort() const override;

  /// Uses this estimate for the goal's cell from now on, also on a map in which more is blocked
  /// than the estimate knows: it then only costs time.
  void use_goal_distance(std::shared_ptr<GoalDistance> distance);
  /// The estimate that the last search used; null before the first one.
  [[nodiscard]] std::shared_ptr<GoalDistance> goal_distance() const;

 private:
  class Search;
  std::unique_ptr<Search> search_;
};

}  // namespace linewright
