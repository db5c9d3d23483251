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
};

/// "makespan", "success_rate", "progress", "distance": as in experiment files and results.
[[nodiscard]] const std::vector<std::string>& metric_names();
[[nodiscard]] const std::string& name_of(Metric metric);

/// One row of an experiment: who decides.
struct ExperimentRow {
  std::string name;       ///< in tables
  std::string algorithm;  ///< of algorithms/, or a file; trained once per seed; empty: `planner`
  std::string planner;    ///< PlannerRegistry
  std::string allocator = "sap";
  std::string paper;  ///< the row of the paper's table; empty: none
};

/// Something that the paper says about two rows, to be judged by our runs.
struct Claim {
  std::string says;
  std::string lower;  ///< row whose mean should be the lower one
  std::string than;   ///< the other row
  Metric metric = Metric::kMakespan;
};

/// A table of the paper, or one of ours: rows of planners or algorithms, played with every crew of
/// the scenario from the same starts (common random numbers). Files: docs/formats/experiment.md.
struct Experiment {
  enum class Columns : std::uint8_t {
    kCrews,   ///< a column per crew; one order
    kOrders,  ///< a column per order; the mean of all crews
  };

  std::string name;  ///< the file's, without its folder and ending
  std::string title;
  std::string about;
  std::string scenario;  ///< file
  std::string paper;     ///< table of the paper's figures; empty: none
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

/// Reads an experiment; with `quick` what its key `quick` says counts instead. Throws ScenarioError
/// with everything that is wrong, where it stands, and the nearest known key. The scenario's file
/// is as the user would name it.
[[nodiscard]] Experiment load_experiment(const std::string& file, bool quick);

}  // namespace linewright
