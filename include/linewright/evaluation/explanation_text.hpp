#pragma once

#include <string>

#include "linewright/line/line_model.hpp"
#include "linewright/planning/explain.hpp"
#include "linewright/simulation/run_setup.hpp"

namespace linewright {

/// The explanation of a decision for a person to read: several lines, each ended by a newline; ways
/// in ticks and metres. Names are those of the event log; `setup` is the run's.
[[nodiscard]] std::string explanation_text(const LineModel& line, const RunSetup& setup,
                                           const DecisionExplanation& explanation);

}  // namespace linewright
