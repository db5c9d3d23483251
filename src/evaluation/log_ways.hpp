#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>

#include "linewright/line/line_model.hpp"
#include "linewright/simulation/event_log.hpp"

// How ways and zones are written into an event log (docs/formats/event_log.md).
namespace linewright::event_log {

/// Adds when the way begins and ends, its metres and the line it follows.
void write_way(nlohmann::ordered_json& out, const LineModel& line, const LogEvent& event,
               WorkerKindId kind);

[[nodiscard]] nlohmann::ordered_json pose_json(const Pose2& pose);

/// The line's zones and when each is closed in this run.
[[nodiscard]] nlohmann::ordered_json zone_list(const LineModel& line, const RunSetup& setup);

}  // namespace linewright::event_log
