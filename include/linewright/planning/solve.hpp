#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "linewright/planning/planner.hpp"
#include "linewright/planning/replay.hpp"
#include "linewright/simulation/run_setup.hpp"
#include "linewright/simulation/simulator.hpp"

namespace linewright {

/// What solve may choose, and how long it looks. At least one of the two budgets is set; the first
/// that is used up ends the search.
struct SolveOptions {
  bool free_agents =
      false;          ///< also choose who does a task (default: the context's allocator does)
  bool wait = false;  ///< also wait where that is better
  std::int64_t budget_ns = 0;  ///< by PlannerContext::now_ns; 0: not set
  std::size_t rollouts = 0;    ///< futures played; 0: not set. Gives the same on every machine
  std::size_t chains = 0;      ///< independent searches; 0: one per thread, 4 with `rollouts`
  std::uint64_t seed = 1;
  /// Planners whose runs the search starts from, besides every dispatching rule.
  std::vector<std::string> warm_starts;
};

/// How far a search is.
struct SolveProgress {
  bool finished = false;  ///< the best plan finishes the order
  Tick makespan = 0;      ///< its makespan; while none finishes: the horizon
  std::size_t rollouts = 0;
  double share = 0.0;  ///< of the budget used, 0 ... 1
};

/// The best plan found: `replay` plays it, with the allocator of the context as fallback.
struct Solution {
  std::vector<RecordedDecision> decisions;
  bool finished = false;
  Tick makespan = 0;       ///< as SolveProgress::makespan
  std::string warm_start;  ///< the planner that the best run without a search is of
  Tick warm_makespan = 0;  ///< its makespan; of one that does not finish: the horizon
  std::size_t rollouts = 0;
};

/// Looks for the best schedule from one start off-line: simulated annealing over whole plans,
/// several at once, from the runs of the other planners. When PlannerContext::cancel is requested
/// the best so far is the result. `progress` (may be empty) is called from the caller's thread.
/// Throws ScenarioError when there is no budget, no clock for one in time, the allocator draws at
/// random, or not one future ends within the budget.
[[nodiscard]] Solution solve(const Simulator& simulator, const RunSetup& setup,
                             const SolveOptions& options, const PlannerContext& context,
                             const std::function<void(const SolveProgress&)>& progress = {});

}  // namespace linewright
