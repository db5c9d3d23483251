#pragma once

#include <nlohmann/json.hpp>

#include "linewright/scenario/scenario.hpp"
#include "linewright/simulation/run_setup.hpp"

namespace linewright::event_log {

/// The first line of an event log (docs/formats/event_log.md).
[[nodiscard]] nlohmann::ordered_json header_json(const Scenario& scenario, const RunSetup& setup);

}  // namespace linewright::event_log
