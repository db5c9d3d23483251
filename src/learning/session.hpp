#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "checkpoint.hpp"
#include "collector.hpp"
#include "episode_replay.hpp"
#include "linewright/environment/vector_environment.hpp"
#include "linewright/learning/trainer.hpp"
#include "linewright/network/policy_file.hpp"
#include "linewright/training/episode_end.hpp"
#include "run_logs.hpp"

namespace linewright::learning {

/// What every trainer needs around its loop: the runs, greedy evaluations, the kept policy, logs
/// and the checkpoint file.
class Session {
 public:
  Session(const TrainingRun& run, const TrainingHooks& hooks);

  [[nodiscard]] const TrainingOptions& options() const { return run_.options; }
  [[nodiscard]] const ObservationSpec& spec() const { return environments_.spec(); }
  [[nodiscard]] std::uint64_t seed() const { return run_.seed; }
  [[nodiscard]] std::size_t threads() const { return pool_.size(); }
  [[nodiscard]] bool cancelled() const {
    return hooks_.cancel != nullptr && hooks_.cancel->requested();
  }
  [[nodiscard]] Collector& collector() { return collector_; }
  /// The options' network, with what follows from the kind of algorithm.
  [[nodiscard]] const NetworkOptions& network() const { return run_.options.network; }
  [[nodiscard]] EpisodeReplayer replayer() const;
  /// Puts the runs where a checkpoint has them.
  void restore_runs(const Checkpoint& checkpoint);
  [[nodiscard]] TrainingStatus& status() { return status_; }
  [[nodiscard]] const TrainingStatus& status() const { return status_; }

  /// The folder's checkpoint, when the run is to be resumed.
  [[nodiscard]] std::optional<Checkpoint> resumed();
  /// Starts the logs (anew, or cut back to the checkpoint) and takes over its figures.
  void open_logs(const Checkpoint* checkpoint);

  /// Takes a finished episode into the means of the status.
  void count(const FinishedEpisode& episode);
  /// Takes an update into the means since the last report.
  void count(const UpdateReport& report);

  /// Whether `every` divides the number of updates that have just been made.
  [[nodiscard]] bool due(std::int64_t every) const;
  /// Runs greedily, keeps the policy when it is the best so far, logs.
  void evaluate(const TensorMap& tensors);
  /// Logs the status and starts new means.
  void report();
  /// Shows the status to the outside.
  void show() const;

  /// Fills in the figures and writes the file; a failure leaves the old one.
  void write_checkpoint(Checkpoint checkpoint);
  void write_policy(const std::string& name, const TensorMap& tensors) const;
  /// Logs are written to disk, and the last policy is saved.
  [[nodiscard]] TrainingResult finish(const TensorMap& tensors);

  [[noreturn]] void refuse_not_finite(const UpdateReport& report) const;

 private:
  [[nodiscard]] std::string path(const std::string& name) const { return run_.folder + "/" + name; }
  void refresh_means();
  [[nodiscard]] std::string options_text() const;
  [[nodiscard]] std::string scenario_text() const;
  [[nodiscard]] Policy policy_of(const TensorMap& tensors) const;

  TrainingRun run_;
  TrainingHooks hooks_;
  Simulator simulator_;
  EpisodePlan plan_;
  WorkerPool pool_;
  VectorEnvironment environments_;
  Collector collector_;
  TrainingStatus status_;
  std::deque<EpisodeFigures> recent_;
  std::vector<double> interval_;
  std::optional<RunLogs> logs_;
};

[[nodiscard]] EpisodeEndOptions episode_end_options(const BufferSettings& buffer);

/// Linear from `start` to `end` as `share` goes from 0 to 1.
[[nodiscard]] double between(double start, double end, double share);

}  // namespace linewright::learning
