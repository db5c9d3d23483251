#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "common.hpp"
#include "linewright/evaluation/recorded_run.hpp"
#include "linewright/planning/explain.hpp"
#include "linewright/planning/replay.hpp"
#include "watch.hpp"

// How `simulate` shows a run.
namespace linewright::cli {

/// Options of `simulate`.
struct SimulateArguments {
  RunArguments run;
  WatchArguments watch;
  std::string log;
  std::string gantt;
  std::string decisions;
  bool explain = false;
};

/// A run that has ended, and what a replay had to compare.
struct Outcome {
  SimulationState state;
  EventLog log;
  std::optional<RecordedRun> recorded;
  ReplayResult replayed;
  std::vector<MilestoneComparison> milestones;
  std::vector<DecisionExplanation> explained;  ///< with --explain: every decision, in order
  std::string explanations;                    ///< the same, to be read by people
};

/// The object of docs/cli.md, simulate.
[[nodiscard]] nlohmann::ordered_json simulation_json(const Simulator& simulator,
                                                     const SimulateArguments& arguments,
                                                     const Outcome& outcome);

/// Tables of what the run came to, and of what a replay found different.
[[nodiscard]] std::string simulation_text(const Simulator& simulator,
                                          const SimulateArguments& arguments,
                                          const Outcome& outcome);

}  // namespace linewright::cli
