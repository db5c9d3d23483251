#pragma once

#include <optional>
#include <string>
#include <vector>

#include "linewright/evaluation/statistics.hpp"
#include "linewright/experiments/cell.hpp"
#include "linewright/experiments/experiment.hpp"
#include "linewright/experiments/paper.hpp"
#include "linewright/experiments/training_record.hpp"

namespace linewright {

/// The results of one row: [training seed][order]; planners that are not trained have one "seed".
using RowResults = std::vector<std::vector<CellResult>>;

/// What an interval is over: how much the number would change with other ... .
enum class Sampled : std::uint8_t {
  kSeeds,   ///< training seeds
  kStarts,  ///< start positions: one policy, or a planner that is not trained
};

/// "seeds" or "starts".
[[nodiscard]] const char* name_of(Sampled sampled);

/// One number of a table, in the metric's unit.
struct TableValue {
  std::optional<double> mean;  ///< none: there is no such number, as the distance of a bound
  /// Half-width of the 95 % interval (Student's t) over TableRow::over; none: one number only.
  std::optional<double> ci95;
  std::optional<double> low;    ///< lower end of the interval; not below 0 where nothing can be
  std::optional<double> high;   ///< upper end; not above 1 for shares
  std::optional<double> paper;  ///< the same figure in the paper

  /// Ours divided by the paper's; none without one, or where that is 0.
  [[nodiscard]] std::optional<double> ratio() const;
};

struct TableRow {
  std::string name;
  std::size_t seeds = 1;  ///< training seeds
  Sampled over = Sampled::kStarts;
  std::size_t samples = 1;         ///< how many seeds or starts the intervals are over
  std::vector<TableValue> values;  ///< by column

  [[nodiscard]] bool has_paper() const;  ///< for any column
};

/// One metric of an experiment.
struct ResultTable {
  Metric metric = Metric::kMakespan;
  std::vector<std::string> columns;  ///< crews and "mean", or orders
  std::vector<TableRow> rows;
};

/// How our runs judge a claim: the difference of the means of the two rows over all columns.
struct JudgedClaim {
  enum class Verdict : std::uint8_t {
    kHolds,     ///< the whole 95 % interval of the difference is on the claimed side
    kContrary,  ///< ... on the other side
    kOpen,      ///< the interval holds zero, or there is none
  };
  Claim claim;
  MeanDifference difference;  ///< `lower` minus `than`: claimed to be negative
  Sampled lower_over = Sampled::kStarts;
  Sampled than_over = Sampled::kStarts;
  Verdict verdict = Verdict::kOpen;
};

/// "holds", "contrary" or "open".
[[nodiscard]] const char* name_of(JudgedClaim::Verdict verdict);

/// Everything that one experiment shows.
struct ExperimentResult {
  Experiment experiment;
  std::vector<ResultTable> tables;  ///< one per metric
  std::vector<JudgedClaim> claims;
};

/// Puts the results of all rows together. `results`: by row; each seed with as many orders as the
/// experiment has and the same crews; throws std::out_of_range where one is missing. With `paper`
/// its figures stand beside.
[[nodiscard]] ExperimentResult make_tables(const Experiment& experiment,
                                           const std::vector<RowResults>& results,
                                           const PaperTables* paper = nullptr);

/// The same for an experiment whose columns are those of training. `records`: by row and seed; a
/// run without a record is left out, and a row without any has no numbers.
[[nodiscard]] ExperimentResult make_training_table(
    const Experiment& experiment, const std::vector<std::vector<TrainingRecord>>& records,
    const PaperTables* paper = nullptr);

}  // namespace linewright
