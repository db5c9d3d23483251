#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

// Training runs of `reproduce`: several `linewright-train` side by side.
namespace linewright::cli {

/// One run of `linewright train`.
struct TrainJob {
  std::string algorithm;  ///< a name of the folder algorithms/ or a file
  std::string scenario;   ///< file
  std::uint64_t seed = 1;
  std::string out;               ///< the run's folder is OUT/ALGORITHM-sSEED
  std::vector<std::string> set;  ///< options, as `train --set`

  [[nodiscard]] std::string name() const;  ///< of the algorithm, without folder and ending
  [[nodiscard]] std::string folder() const;
  /// The policy that the run keeps, once it is done: the best one, or where no evaluation had every
  /// run succeed the last one.
  [[nodiscard]] std::string policy() const;
  [[nodiscard]] bool has_best() const;
  [[nodiscard]] bool is_done() const;
};

/// Runs all jobs that are not done, one per core, with a line of progress, and goes on from the
/// checkpoints of runs that were interrupted. After Ctrl-C the runs write a checkpoint each and it
/// returns false. Throws ScenarioError when there is no trainer and when a run fails (its last
/// words are in FOLDER.log), after the others have ended.
[[nodiscard]] bool run_train_jobs(const std::vector<TrainJob>& jobs, std::size_t cores);

/// The program that trains, beside this one. Throws ScenarioError when there is none.
[[nodiscard]] std::string trainer_program();

}  // namespace linewright::cli
