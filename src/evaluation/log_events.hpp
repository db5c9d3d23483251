#pragma once

#include "linewright/evaluation/log_document.hpp"
#include "log_header.hpp"

namespace linewright::event_log {

/// One line after the header: something that happened, or the end.
using LogLine = std::variant<LoggedEvent, LoggedEnd>;

/// Reads one line after the header. Throws ScenarioError. Does not compare it with earlier lines.
[[nodiscard]] LogLine read_log_line(const Json& line, const LogPosition& where,
                                    const LogIndex& index);

/// The decision number of an event, when it has one.
[[nodiscard]] std::optional<std::int32_t> decision_number(const LoggedEvent& event);

}  // namespace linewright::event_log
