#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "linewright/planning/planner.hpp"

namespace linewright {

/// How far and how long the planner `lookahead` looks. Just one of the two budgets is set.
struct LookaheadOptions {
  /// Nanoseconds per decision, the decision's own work included; 0: not set. More finds better
  /// plans: on the duct line little is gained beyond 10 ms.
  std::int64_t budget_ns = 0;
  /// Futures played per decision (at the first one at least one of every base planner); 0: not set.
  /// One takes as long as the run it plays (30 us for an order of five on the duct line). The same
  /// number gives the same decisions on every machine.
  std::size_t rollouts = 0;
  /// The planner that futures begin with and fall back to (any but `lookahead`); empty: every
  /// dispatching rule is tried, and `priority:tuned` where the scenario has one.
  std::string base;
  bool free_agents = false;  ///< also choose who does a task (default: the allocator does)
  bool wait = false;  ///< also wait where that is better, whatever LineModel::allow_wait says
  /// Searches from the same start that go on independently of each other; the best one counts.
  /// Threads share them. 0: one per thread for budgets in time, 4 for rollouts.
  std::size_t chains = 0;
  std::size_t threads = 0;  ///< 0: as many as PlannerContext::threads
};

/// "10ms", "200r", "10ms,base=priority:1,2,8,agents=free,wait=true,chains=4,threads=2". Throws
/// ScenarioError for what is no budget (or one of zero), unknown or repeated options and bad
/// values.
[[nodiscard]] LookaheadOptions parse_lookahead(std::string_view text);

/// The planner `lookahead`: at each decision it plays futures to the end of the order from a copy
/// of the state, keeps the best one found so far, improves it by local search and decides what
/// comes first in it. It never does worse than going on with the best future would, so with an
/// allocator that draws nothing a run is never longer than that of its base planner from the same
/// start. When no future ends within the budget it decides as its base planner. Throws
/// ScenarioError when a budget in time is asked for without a clock, and for a base that does not
/// exist.
[[nodiscard]] std::unique_ptr<Planner> make_lookahead_planner(const Simulator& simulator,
                                                              const LookaheadOptions& options,
                                                              const PlannerContext& context);

}  // namespace linewright
