#pragma once

#include <memory>
#include <string>
#include <vector>

#include "linewright/planning/planner.hpp"

// The planners that searches begin with.
namespace linewright::planning {

/// `first`, every dispatching rule and, where the scenario has one that fits, `priority:tuned`
/// (before the others).
[[nodiscard]] std::vector<std::unique_ptr<Planner>> simple_planners(const Simulator& simulator,
                                                                    const PlannerContext& context);

/// The planner of that name; of an empty one the first of simple_planners.
[[nodiscard]] std::unique_ptr<Planner> base_planner(const std::string& spec,
                                                    const Simulator& simulator,
                                                    const PlannerContext& context);

}  // namespace linewright::planning
