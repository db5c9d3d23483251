#pragma once

#include "linewright/evaluation/log_document.hpp"
#include "log_fields.hpp"

namespace linewright::event_log {

inline constexpr const char* kFormat = "linewright/event_log/1";

/// The names that events may use, by kind of thing.
struct LogIndex {
  LogNames workers{"worker"};
  LogNames carriers{"carrier"};
  LogNames stations{"station"};
  LogNames places{"place"};
  LogNames machines{"machine"};
  LogNames operations{"operation"};
  LogNames tasks{"task"};
  LogNames zones{"zone"};
};

/// Reads the first line of a log and fills `index`. Throws ScenarioError.
[[nodiscard]] LogHeader read_log_header(const Json& line, const LogPosition& where,
                                        LogIndex& index);

}  // namespace linewright::event_log
