#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "linewright/base/cancel.hpp"
#include "linewright/base/tick.hpp"
#include "linewright/evaluation/trials.hpp"
#include "linewright/scenario/scenario.hpp"

namespace linewright {

/// One evaluation of an experiment: a planner and an allocator with one order, every crew of the
/// scenario; or the lower bound of the makespan of each run, whoever plans.
struct ExperimentCell {
  std::string planner;  ///< PlannerRegistry; of a trained algorithm `policy:FILE`; or empty and
  std::string bound;    ///< ... the name of a bound: "combined"
  std::string allocator = "sap";
  std::int32_t order = 1;
  std::optional<Tick> horizon;  ///< none: the scenario's
  std::size_t trials = 100;     ///< per crew
  std::uint64_t seed = 1;       ///< of the start positions
  bool shield = false;
};

/// What came out, run by run: trial i of every cell with the same order and seed has the same
/// start. Of a bound there are makespans only; the other lists are empty.
struct CellResult {
  struct Crew {
    std::string name;                     ///< "H2R1"
    std::vector<Tick> makespan;           ///< of a failed run: its horizon
    std::vector<std::uint8_t> finished;   ///< 1: the order was finished
    std::vector<double> progress;         ///< share of the order that was finished, 0 to 1
    std::vector<double> distance_m;       ///< of all workers together
    std::vector<std::int32_t> decisions;  ///< tasks that were started, waiting not counted
  };
  std::vector<Crew> crews;
  double wall_s = 0.0;  ///< seconds that the runs took
};

/// What the results of a cell depend on, hashed: 16 hex digits. The contents of the scenario and of
/// the policy or the tuned priority list count, not the names of their files. So does what the
/// program does: the event log of the largest crew's first run (for planners with a budget in time:
/// with the planner `first`), or its bound, so that a program that behaves otherwise finds no
/// results of another one. Throws ScenarioError as run_cell() does.
[[nodiscard]] std::string key_of(const ExperimentCell& cell, const Scenario& scenario);

/// Plays the cell, or computes its bounds. None when cancelled. Throws ScenarioError for planners
/// and allocators that do not exist or do not fit the scenario. `now_ns`: a clock.
[[nodiscard]] std::optional<CellResult> run_cell(const ExperimentCell& cell,
                                                 const Scenario& scenario,
                                                 const std::function<std::int64_t()>& now_ns,
                                                 const TrialProgress& progress = {},
                                                 const CancelToken* cancel = nullptr);

/// Results in a folder, one file per cell, so that what was interrupted goes on where it stopped.
class CellStore {
 public:
  explicit CellStore(std::string folder) : folder_(std::move(folder)) {}

  /// None when the cell was not run yet. Throws ScenarioError for a file that is none of ours.
  [[nodiscard]] std::optional<CellResult> find(const std::string& key) const;
  /// Throws ScenarioError when the file cannot be written.
  void keep(const std::string& key, const ExperimentCell& cell, const CellResult& result) const;

 private:
  [[nodiscard]] std::string file_of(const std::string& key) const;

  std::string folder_;
};

}  // namespace linewright
