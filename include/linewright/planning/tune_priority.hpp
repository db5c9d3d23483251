#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "linewright/base/cancel.hpp"
#include "linewright/base/id.hpp"
#include "linewright/simulation/run_setup.hpp"
#include "linewright/simulation/simulator.hpp"

namespace linewright {

/// What tune_priority has found so far.
struct TunedPriority {
  std::vector<TaskId> order;  ///< every task of the line, first to last
  double makespan =
      0.0;  ///< mean over all crews and starts; failed runs count with twice the horizon
  double success_rate = 0.0;
  std::size_t runs = 0;  ///< simulated so far
};

/// Which order is the best, and how hard to look for it.
struct TuneOptions {
  std::vector<RunOptions> crews;  ///< at least one
  std::string allocator = "sap";
  /// Start positions per crew, >= 1. More fit the order less to chance, and cost in proportion.
  std::size_t starts = 50;
  /// Simulated runs after which the search ends, >= 1 (30 us each and thread on the duct line,
  /// where the best order is found within 50'000).
  std::size_t most_runs = 300'000;
  std::uint64_t seed = 1;               ///< of starts and of the search
  std::size_t threads = 0;              ///< 0: one per core. Never changes the result
  const CancelToken* cancel = nullptr;  ///< ends the search: the best so far is the result
  /// Called after every round of the search, from the caller's thread.
  std::function<void(const TunedPriority& best)> progress;
};

/// Finds a fixed order of the tasks (planner `priority:LIST`) with a low mean makespan: iterated
/// local search over moves of one task to another place. All orders are tried on the same starts
/// (common random numbers), and an order that looks worse after a few of them is dropped (racing).
/// The same options give the same order on every machine. Throws ScenarioError for crews or an
/// allocator that do not exist.
[[nodiscard]] TunedPriority tune_priority(const Simulator& simulator, const TuneOptions& options);

/// The same by trying every order there is, `most_runs` aside: after 1, 3, 10 and 30 % of the
/// starts (each crew at least once) those go on whose mean is near the best (60 % of it, divided by
/// the root of the number of runs). The best is known (`makespan` above 0) after the first round.
/// Throws ScenarioError as above, and for a line with more than kMostOrders orders.
[[nodiscard]] TunedPriority try_all_orders(const Simulator& simulator, const TuneOptions& options);

inline constexpr std::size_t kMostOrders = 400'000;  ///< those of nine tasks
/// Orders of the line's tasks; more than kMostOrders: not counted further.
[[nodiscard]] std::size_t orders_of(const LineModel& line);

}  // namespace linewright
