#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace linewright {

/// Numbers by line and column, as training runs log them (progress.csv, evaluations.csv).
struct NumberTable {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;  ///< each with a number per column

  /// None: there is no such column.
  [[nodiscard]] std::optional<std::size_t> find(std::string_view column) const;
};

/// What a training run wrote about itself.
struct TrainingRecord {
  NumberTable progress;     ///< of the training episodes, by update; empty: not kept
  NumberTable evaluations;  ///< greedy ones of all crews, by update; empty: not kept

  /// Of wall clock, from the first to the last line of its log; none: not kept.
  [[nodiscard]] std::optional<double> minutes() const;
  /// The same up to the first line with at least so many updates.
  [[nodiscard]] std::optional<double> minutes_until(double updates) const;
  /// The last number of a column of `progress`, such as "updates".
  [[nodiscard]] std::optional<double> last(std::string_view column) const;
  /// The smallest mean makespan of an evaluation in which every run finished its order.
  [[nodiscard]] std::optional<double> best_makespan() const;
  /// The update of the first such evaluation with at most this makespan.
  [[nodiscard]] std::optional<double> updates_until(double makespan) const;
};

/// Reads the CSV of such a log. Throws ScenarioError naming file and line for anything else.
[[nodiscard]] NumberTable load_number_table(const std::string& file);

/// The record of a run from its two logs, of which either may be absent.
[[nodiscard]] TrainingRecord load_training_record(const std::string& progress_file,
                                                  const std::string& evaluations_file);

}  // namespace linewright
