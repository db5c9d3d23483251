#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "linewright/line/line_model.hpp"
#include "linewright/planning/explain.hpp"

namespace linewright::event_log {

/// The key `why` of a decision (docs/formats/event_log.md). `workers`: names by WorkerId.
[[nodiscard]] nlohmann::ordered_json explanation_json(const LineModel& line,
                                                      const std::vector<std::string>& workers,
                                                      const DecisionExplanation& explanation);

}  // namespace linewright::event_log
