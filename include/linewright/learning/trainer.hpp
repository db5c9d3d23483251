#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "linewright/base/cancel.hpp"
#include "linewright/scenario/scenario.hpp"
#include "linewright/training/training_options.hpp"

namespace linewright {

/// Greedy runs of the agent as it is: all crews of the scenario, the same starts every time.
struct EvaluationReport {
  std::int64_t update = 0;
  double makespan = 0.0;  ///< mean over all runs, ticks; a failed run counts with its horizon
  double success = 0.0;   ///< share of runs that finished the order
  double progress = 0.0;  ///< mean share of the order finished
  bool all_succeeded = false;
  std::vector<double> crew_makespan;  ///< by crew, in the order of the crews
};

/// How a training run stands; means are over the last 100 episodes.
struct TrainingStatus {
  std::int64_t updates = 0;
  std::int64_t most_updates = 0;
  std::int64_t decisions = 0;
  std::int64_t episodes = 0;
  std::int64_t stored = 0;  ///< transitions stored so far, copies counted
  double reward = 0.0;      ///< of an episode, as the environment paid it
  double length = 0.0;      ///< decisions of an episode
  double makespan = 0.0;
  double progress = 0.0;
  double success = 0.0;
  double epsilon = 0.0;
  double learning_rate = 0.0;
  double loss = 0.0;  ///< mean since the last report
  double mean_q = 0.0;
  double gradient_norm = 0.0;
  std::optional<EvaluationReport> best;    ///< the evaluation that the kept policy comes from
  std::optional<EvaluationReport> latest;  ///< the last evaluation
};

/// One training run: everything that decides its result, and where it is written.
struct TrainingRun {
  const Scenario* scenario = nullptr;
  TrainingOptions options;
  std::uint64_t seed = 1;
  /// Gets options.yaml, checkpoint.bin, progress.csv, evaluations.csv, a TensorBoard event file,
  /// best.safetensors (the policy of the best evaluation) and final.safetensors.
  std::string folder;
  bool resume = false;  ///< go on from the folder's checkpoint; an error when there is none
  /// Added to the policies' metadata.
  std::map<std::string, std::string> metadata;
};

/// What the outside gives to a run.
struct TrainingHooks {
  /// Called after every round of the loop (some 10 ms) from the training thread.
  std::function<void(const TrainingStatus&)> progress;
  /// Seconds since 1970, for the logs only; never influences the result.
  std::function<double()> wall_time_s;
  const CancelToken* cancel = nullptr;  ///< then a checkpoint is written and the run ends
};

/// How a run ended.
struct TrainingResult {
  bool finished = false;  ///< false: cancelled; it can be resumed
  TrainingStatus status;
  std::string best_policy;  ///< file; empty when no evaluation had all crews succeed
};

/// Trains the agent of `run.options` (paper, Algorithm 1 for `dqn`; PPO for `ppo`). The kept policy
/// is the one with the smallest mean makespan among the evaluations in which every run succeeded;
/// ties: the earlier one. Deterministic for a seed, also across resuming, whatever the number of
/// threads. Throws ScenarioError for options that do not fit the scenario, a horizon too short for
/// the order, a checkpoint that is missing, damaged or of another run, a file that cannot be
/// written, and when the loss is no longer a number: the last good checkpoint and the best policy
/// then stay.
[[nodiscard]] TrainingResult train(const TrainingRun& run, const TrainingHooks& hooks);

/// Every crew of the scenario (all combinations of its counts, the first kind varying slowest),
/// with the order and the horizon of the options. Deterministic, though some of it may come from
/// trial runs.
[[nodiscard]] std::vector<RunOptions> training_crews(const Scenario& scenario,
                                                     const RunSettings& settings);

}  // namespace linewright
