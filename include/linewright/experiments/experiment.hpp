#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "linewright/base/tick.hpp"

namespace linewright {

/// What a table of an experiment shows of the runs.
enum class Metric : std::uint8_t {
  kMakespan,     ///< ticks; a failed run counts with its horizon
  kSuccessRate,  ///< share of the runs that finished their order, 0 to 1
  kProgress,     ///< mean share of the order that was finished, 0 to 1
  kDistance,     ///< metres, all workers together
  kDecisions,    ///< tasks that were started, waiting not counted
  kTraining,     ///< of the training runs; what and in which unit: training_columns()
};

/// "makespan", "success_rate", "progress", "distance", "decisions", "training": as in experiment
/// files and results.
[[nodiscard]] const std::vector<std::string>& metric_names();
[[nodiscard]] const std::string& name_of(Metric metric);

/// One row of an experiment: who decides.
struct ExperimentRow {
  std::string name;              ///< in tables
  std::string algorithm;         ///< of algorithms/, or a file; trained once per seed; empty: none
  std::vector<std::string> set;  ///< options that differ from it, as `train --set`
  std::string planner;           ///< PlannerRegistry; empty: none
  std::string bound;             ///< lower bound of the makespan, "combined"; empty: none
  std::string allocator = "sap";
  std::string paper;                  ///< the row of the paper's table; empty: none
  std::optional<std::size_t> trials;  ///< none: as many as the experiment; the first ones of those
};

/// Something that the paper says about two rows, to be judged by our runs.
struct Claim {
  std::string says;
  std::string lower;  ///< row whose mean should be the lower one
  std::string than;   ///< the other row
  Metric metric = Metric::kMakespan;
  std::string column;  ///< kTraining: one of training_columns(); else empty: their mean
};

/// A table of the paper, or one of ours: rows of planners or algorithms, played with every crew of
/// the scenario from the same starts (common random numbers). Files: docs/formats/experiment.md.
struct Experiment {
  enum class Columns : std::uint8_t {
    kCrews,     ///< a column per crew; one order
    kOrders,    ///< a column per order; the mean of all crews
    kTraining,  ///< training_columns(), of the training runs; nothing is played
  };

  std::string name;  ///< the file's, without its folder and ending
  std::string title;
  std::string about;
  std::string scenario;      ///< file
  std::string trained_on;    ///< the scenario's file on which algorithms are trained
  std::string paper;         ///< table of the paper's figures; empty: none
  std::string paper_tables;  ///< the file with the paper's figures
  std::string base;          ///< row with which the others are compared in figures; empty: none
  Columns columns = Columns::kCrews;
  std::vector<std::int32_t> orders;  ///< quantities ordered; kCrews: exactly one
  std::vector<Metric> metrics;
  std::vector<ExperimentRow> rows;
  std::vector<Claim> claims;
  std::vector<std::uint64_t> seeds;  ///< of training
  std::size_t trials = 100;          ///< per crew and order
  std::uint64_t starts_seed = 1;     ///< of the start positions
  bool shield = false;               ///< decisions that can never be finished are ruled out
  std::optional<Tick> horizon;       ///< none: the scenario's
};

/// The quantities of a training run that tables show: "minutes" (of wall clock), "updates" (steps
/// of the optimizer), "episodes", "decisions", "best makespan" (ticks; mean of all crews in the
/// best evaluation), and "updates to 5 %" and "minutes to 5 %": until an evaluation was within 5 %
/// of the best one of all runs of the table.
[[nodiscard]] const std::vector<std::string>& training_columns();

/// Reads an experiment; with `quick` what its key `quick` says counts instead. Throws ScenarioError
/// with everything that is wrong, where it stands, and the nearest known key. The scenario's file
/// is as the user would name it.
[[nodiscard]] Experiment load_experiment(const std::string& file, bool quick);

}  // namespace linewright
