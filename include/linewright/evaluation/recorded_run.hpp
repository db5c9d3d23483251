#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "linewright/line/line_model.hpp"
#include "linewright/planning/replay.hpp"
#include "linewright/simulation/event_log.hpp"

namespace linewright {

/// A milestone of a recorded run: what (`flange_welded`), where or of which (`inner`, or a running
/// number, which carries no meaning here), when.
struct RecordedMilestone {
  Tick tick = 0;
  std::string name;
  std::string label;  ///< empty when the record has a number or nothing
};

/// A recorded run (docs/formats/decisions.md), or an event log of ours read as one.
struct RecordedRun {
  std::string file;
  RunSetup setup;
  std::vector<RecordedDecision> decisions;
  std::vector<RecordedMilestone> milestones;
  std::optional<bool> finished;
  std::optional<Tick> makespan;
};

/// Reads a record for the line. Throws ScenarioError naming the file and every entry that does not
/// fit.
[[nodiscard]] RecordedRun load_recorded_run(const std::string& file, const LineModel& line);

/// The same from text; `file` is only used in diagnostics.
[[nodiscard]] RecordedRun read_recorded_run(const std::string& text, const std::string& file,
                                            const LineModel& line);

/// A recorded milestone beside ours of the same name, label and rank.
struct MilestoneComparison {
  RecordedMilestone recorded;
  std::optional<Tick> ours;  ///< none: did not happen (that often)
};

/// Milestones of the record beside those of a replay's log. A record's `name` with `label` means
/// our milestone `name.label`, else `name`, else (task_start, task_end) the log's own; without
/// label all `name` and `name.*` in order of time.
[[nodiscard]] std::vector<MilestoneComparison> compare_milestones(const RecordedRun& run,
                                                                  const LineModel& line,
                                                                  const EventLog& log);

}  // namespace linewright
