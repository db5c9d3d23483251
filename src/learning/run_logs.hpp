#pragma once

#include <string>
#include <vector>

#include "linewright/learning/trainer.hpp"
#include "linewright/training/csv_log.hpp"
#include "linewright/training/tensorboard.hpp"

namespace linewright::learning {

/// The log files of a run: progress.csv, evaluations.csv and a TensorBoard event file with
/// Stable-Baselines3's tags, ours under linewright/ (docs/algorithms/ebq.md).
class RunLogs {
 public:
  /// `sizes` empty: new files; else old ones, cut back to what sizes() once gave.
  RunLogs(const std::string& folder, const std::vector<std::string>& crews,
          const std::vector<std::uint64_t>& sizes, double wall_time_s);

  void progress(const TrainingStatus& status, double wall_time_s);
  void evaluation(const EvaluationReport& report, double wall_time_s);
  void flush();
  [[nodiscard]] std::vector<std::uint64_t> sizes() const;

 private:
  std::vector<std::string> crews_;
  CsvLog progress_;
  CsvLog evaluations_;
  TensorBoardLog board_;
};

}  // namespace linewright::learning
