#include "linewright/routing/path_planner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "grid_planner.hpp"
#include "linewright/base/diagnostic.hpp"
#include "linewright/routing/hybrid_a_star.hpp"

namespace linewright {

const std::vector<std::string>& path_planner_names() {
  static const std::vector<std::string> names{"hybrid_a_star", "a_star", "dijkstra"};
  return names;
}

std::unique_ptr<PathPlanner> make_path_planner(std::string_view name,
                                               std::shared_ptr<const ClearanceMap> map,
                                               const Mover& mover,
                                               const PathPlannerOptions& options) {
  if (name == "hybrid_a_star") return std::make_unique<HybridAStar>(std::move(map), mover, options);
  if (name == "a_star" || name == "dijkstra") {
    return std::make_unique<GridPlanner>(std::move(map), mover, options, name == "a_star");
  }
  throw ScenarioError({}, fmt::format("unknown path planner '{}'", name),
                      name_hint(name, path_planner_names()));
}

}  // namespace linewright
