#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "linewright/planning/explain.hpp"
#include "linewright/scenario/scenario.hpp"
#include "linewright/simulation/event_log.hpp"

namespace linewright {

/// `finished`, `deadlock`, `horizon`, or `running` for a run that has not ended.
[[nodiscard]] const char* run_status_name(RunStatus status);

/// Names of the run's workers (`human.0`) by WorkerId.
[[nodiscard]] std::vector<std::string> worker_names(const LineModel& line, const RunSetup& setup);

/// Names of the run's carriers (`cage.0`) by CarrierId.
[[nodiscard]] std::vector<std::string> carrier_names(const LineModel& line, const RunSetup& setup);

/// The log in its written form, docs/formats/event_log.md. Equal logs give equal bytes. `progress`
/// is that of the final state. `explanations`, of all decisions in their order or empty, are
/// written into them; those that wait are left out, as the log has no event for waiting.
[[nodiscard]] std::string event_log_text(const Scenario& scenario, const EventLog& log,
                                         double progress,
                                         const std::vector<DecisionExplanation>& explanations = {});

/// Its parts, for a run that is still going on: the first line, and the lines of the events from
/// `first` on, one each.
[[nodiscard]] std::string event_log_header(const Scenario& scenario, const RunSetup& setup);
[[nodiscard]] std::string event_log_lines(
    const Scenario& scenario, const EventLog& log, std::size_t first, double progress,
    const std::vector<DecisionExplanation>& explanations = {});

}  // namespace linewright
