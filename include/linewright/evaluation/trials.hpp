#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "linewright/base/cancel.hpp"
#include "linewright/evaluation/statistics.hpp"
#include "linewright/planning/planner.hpp"
#include "linewright/scenario/scenario.hpp"
#include "linewright/simulation/run_setup.hpp"
#include "linewright/simulation/state.hpp"

namespace linewright {

/// Who decides: a planner (PlannerRegistry) and an allocator (make_allocator).
struct Configuration {
  std::string planner = "first";
  std::string allocator = "sap";
  /// Decisions after which the order cannot be finished are ruled out (shield.hpp).
  bool shield = false;
  /// Makes the planner where it has no name; then `planner` is only what it is called. Called once
  /// per thread.
  std::function<std::unique_ptr<Planner>(const Simulator&)> make_planner;
};

/// Which runs to make.
struct TrialPlan {
  std::vector<RunOptions> crews;  ///< one row of results each
  std::size_t trials = 100;       ///< runs per crew, >= 1
  std::uint64_t seed = 1;   ///< trial i starts from the same positions whatever the configuration
  std::size_t threads = 0;  ///< 0: one per core. Never changes a result
  /// A clock (PlannerContext::now_ns), for planners with a budget in time and to time decisions.
  std::function<std::int64_t()> now_ns;
};

/// What one worker did, as shares of the run's length; they add up to 1.
struct WorkerShares {
  double work = 0.0;
  double travel = 0.0;
  double wait = 0.0;  ///< in a task, waiting for others or settling
  double idle = 0.0;  ///< in no task
};

/// One run.
struct TrialResult {
  RunStatus status = RunStatus::kRunning;
  Tick makespan = 0;             ///< of a failed run: the horizon
  double progress = 0.0;         ///< share of the order finished
  std::int64_t distance_mm = 0;  ///< all workers together
  std::int64_t distance_ticks = 0;
  std::int32_t decisions = 0;
  std::vector<std::int64_t> decision_ns;  ///< what each decision took; empty without a clock
  std::int64_t shield_ns = 0;             ///< all judging of a Shield; 0 without one or a clock
  std::size_t masked = 0;                 ///< decisions that a Shield has ruled out
  std::vector<WorkerShares> workers;      ///< by WorkerId
  std::vector<double> machines;  ///< busy share (holding and recovery included), by machine
};

/// One crew's trials, put together.
struct TrialSummary {
  std::vector<std::int32_t> crew;  ///< workers by kind
  Spread makespan;                 ///< ticks; failed runs count with the horizon
  double success_rate = 0.0;
  double progress = 0.0;  ///< mean share of the order finished
  Spread distance_m;
  Spread distance_ticks;
  double decisions = 0.0;
  std::vector<WorkerShares> workers;  ///< means
  std::vector<double> machines;
};

/// The seed of sample_setup() for one trial of a plan with this seed.
[[nodiscard]] std::uint64_t trial_setup_seed(std::uint64_t plan_seed, std::size_t trial);

/// Called now and then, from one thread at a time, with the number of finished runs.
using TrialProgress = std::function<void(std::size_t done, std::size_t total)>;

/// Runs crews x trials on several threads; [crew][trial]. The same plan gives the same results
/// whatever the number of threads. When cancelled, returns the crews that are complete. Throws
/// ScenarioError for a configuration or crew that does not exist.
[[nodiscard]] std::vector<std::vector<TrialResult>> run_trials(const Scenario& scenario,
                                                               const Configuration& configuration,
                                                               const TrialPlan& plan,
                                                               const TrialProgress& progress = {},
                                                               const CancelToken* cancel = nullptr);

[[nodiscard]] TrialSummary summarize(const std::vector<TrialResult>& trials,
                                     const RunOptions& crew);

/// Makespans of two configurations on common random numbers: trial i of both has the same start.
struct PairedComparison {
  Spread difference;  ///< second minus first, ticks: negative means that the second is faster
  std::size_t faster = 0;
  std::size_t equal = 0;
  std::size_t slower = 0;
};

[[nodiscard]] PairedComparison compare_paired(const std::vector<TrialResult>& first,
                                              const std::vector<TrialResult>& second);

/// The measurements of a run that has ended.
[[nodiscard]] TrialResult measure(const SimulationState& state, double progress);

}  // namespace linewright
