#pragma once

#include <string_view>
#include <utility>
#include <vector>

#include "linewright/line/line_model.hpp"
#include "linewright/planning/planner.hpp"

namespace linewright::planning {

/// The first task of a fixed order that may be chosen.
class PriorityPlanner final : public Planner {
 public:
  explicit PriorityPlanner(std::vector<TaskId> order) : order_(std::move(order)) {}

  void reset(std::uint64_t /*seed*/) override {}

  [[nodiscard]] Decision decide(const SimulationState& /*state*/, const Choices& choices) override {
    Decision decision;
    for (const TaskId task : order_) {
      if (!choices.tasks.contains(task)) continue;
      decision.task = task;
      break;
    }
    return decision;
  }

 private:
  std::vector<TaskId> order_;
};

[[nodiscard]] std::vector<TaskId> tasks_by_number(const LineModel& line);

/// A comma-separated list of task numbers or names; tasks that it leaves out come last, by number.
/// Throws ScenarioError.
[[nodiscard]] std::vector<TaskId> parse_priority(const LineModel& line, std::string_view list);

}  // namespace linewright::planning
