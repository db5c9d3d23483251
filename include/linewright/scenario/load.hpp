#pragma once

#include <string>
#include <string_view>

#include "linewright/base/diagnostic.hpp"
#include "linewright/scenario/scenario.hpp"

namespace linewright {

/// Reads a scenario file (docs/formats/scenario.md). Throws ScenarioError with every diagnostic
/// found when the file is missing, unreadable, not YAML, or describes no valid line.
[[nodiscard]] Scenario load_scenario(const std::string& file);

/// The same from text; `file_name` is only used in diagnostics. `extends` and the map's `occupancy`
/// are errors here: a text has no folder that the other file could be looked up in.
[[nodiscard]] Scenario load_scenario_text(std::string_view text, const std::string& file_name);

/// The JSON Schema (draft 2020-12) of the scenario format, generated from the same table of keys
/// that the loader checks against; ends with a newline.
[[nodiscard]] std::string scenario_json_schema();

}  // namespace linewright
