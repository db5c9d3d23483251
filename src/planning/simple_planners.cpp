#include "simple_planners.hpp"

#include <utility>

#include "linewright/planning/priority_file.hpp"
#include "linewright/planning/rules.hpp"
#include "priority_planner.hpp"

namespace linewright::planning {

std::vector<std::unique_ptr<Planner>> simple_planners(const Simulator& simulator,
                                                      const PlannerContext& context) {
  std::vector<std::unique_ptr<Planner>> planners;
  const LineModel& line = simulator.line();
  if (auto tuned = find_priority(line, {.scenario_file = context.scenario_file,
                                        .scenario_hash = context.scenario_hash,
                                        .allocator = context.allocator})) {
    planners.push_back(std::make_unique<PriorityPlanner>(*std::move(tuned)));
  }
  planners.push_back(std::make_unique<PriorityPlanner>(tasks_by_number(line)));
  for (const Rule& rule : dispatching_rules()) {
    planners.push_back(make_rule_planner(rule.name, simulator));
  }
  return planners;
}

std::unique_ptr<Planner> base_planner(const std::string& spec, const Simulator& simulator,
                                      const PlannerContext& context) {
  if (!spec.empty()) return PlannerRegistry::make(spec, simulator, context);
  return std::move(simple_planners(simulator, context).front());
}

}  // namespace linewright::planning
