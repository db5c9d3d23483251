#pragma once

#include <memory>
#include <vector>

#include "linewright/allocation/allocator.hpp"
#include "linewright/planning/tune_priority.hpp"
#include "priority_planner.hpp"

namespace linewright::planning {

/// What fixed orders of the tasks are tried on: all crews from the same starts. A run that fails
/// counts with twice its horizon.
class OrderRuns {
 public:
  struct Result {
    double makespan = 0.0;
    bool finished = false;
  };
  /// What one thread runs orders with.
  struct Runner {
    PriorityPlanner planner{{}};
    std::unique_ptr<Allocator> allocator;
    SimulationState state;
  };

  OrderRuns(const Simulator& simulator, const TuneOptions& options);

  /// The crews take turns, so that every part of the starts has all of them.
  [[nodiscard]] std::size_t count() const { return starts_.size(); }
  [[nodiscard]] Runner runner() const;
  /// Runs the order of the runner's planner from one start.
  [[nodiscard]] Result play(Runner& runner, std::size_t start) const;

 private:
  struct Start {
    RunSetup setup;
    std::uint64_t seed = 0;
  };
  const Simulator& simulator_;
  std::string allocator_;
  std::vector<Start> starts_;
};

}  // namespace linewright::planning
