#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "collector.hpp"
#include "linewright/learning/q_learner.hpp"
#include "linewright/learning/trainer.hpp"
#include "linewright/training/replay_buffer.hpp"

namespace linewright::learning {

/// An episode that has ended: enough to play it again.
struct EpisodeRecord {
  std::uint64_t number = 0;
  std::vector<std::uint16_t> actions;
};

/// What an episode adds to the means that are reported.
struct EpisodeFigures {
  double reward = 0.0;
  double length = 0.0;
  double makespan = 0.0;
  double progress = 0.0;
  double success = 0.0;
};

/// Everything that the rest of a training run depends on. Observations are not in it: episodes are
/// played again from their decisions.
struct Checkpoint {
  std::string options;   ///< as YAML
  std::string scenario;  ///< name and hash
  std::uint64_t seed = 0;

  std::int64_t updates = 0;
  std::int64_t decisions = 0;
  std::int64_t episodes = 0;
  std::int64_t stored = 0;
  std::int64_t credit = 0;  ///< decisions that no update has answered yet
  std::vector<EpisodeFigures> recent;
  std::vector<double> interval;  ///< sums since the last report: loss, mean Q, gradient norm, count
  EvaluationReport best;         ///< update -1: none yet
  EvaluationReport latest;

  LearnerState learner;
  RandomStream::State sampling{};
  std::vector<Collector::RunState> runs;
  ReplayState replay;
  std::vector<EpisodeRecord> records;

  std::vector<std::uint64_t> log_sizes;  ///< of the log files, which are cut back to them
};

/// The file: a magic word with the version, the content, and a hash of both.
[[nodiscard]] std::string to_bytes(const Checkpoint& checkpoint);

/// Throws ScenarioError naming `file` for what is no checkpoint, one of another version, cut off or
/// damaged.
[[nodiscard]] Checkpoint checkpoint_from_bytes(std::string_view bytes, const std::string& file);

}  // namespace linewright::learning
