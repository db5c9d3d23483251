#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "linewright/base/cancel.hpp"
#include "linewright/base/diagnostic.hpp"
#include "linewright/scenario/scenario.hpp"

namespace linewright {

/// How a scenario is loaded.
struct LoadOptions {
  /// Keep the routes beside the scenario, in the file NAME.routes (docs/formats/route_cache.md),
  /// and take them from there while they fit.
  bool route_cache = true;
  std::size_t threads =
      0;  ///< to plan routes with; 0: one per core. The result does not depend on it
  const CancelToken* cancel = nullptr;  ///< stops the planning of routes: then ScenarioError
  /// Routes planned so far and in all; from any thread, only while they are planned.
  std::function<void(std::size_t done, std::size_t total)> progress;
  /// What planning all routes may cost: cells of the map times goals (more is an error), and
  /// expansions of all searches together (after which the rest counts as not found). For hostile
  /// input; a large hall takes 1e8.
  std::size_t most_route_work = 2'000'000'000;
};

/// Reads a scenario file (docs/formats/scenario.md). Throws ScenarioError with every diagnostic
/// found when the file is missing, unreadable, not YAML, or describes no valid line.
[[nodiscard]] Scenario load_scenario(const std::string& file, const LoadOptions& options = {});

/// The same from text; `file_name` is only used in diagnostics. `extends` and the map's `occupancy`
/// are errors here: a text has no folder that the other file could be looked up in, and routes are
/// not kept.
[[nodiscard]] Scenario load_scenario_text(std::string_view text, const std::string& file_name,
                                          const LoadOptions& options = {});

/// The JSON Schema (draft 2020-12) of the scenario format, generated from the same table of keys
/// that the loader checks against; ends with a newline.
[[nodiscard]] std::string scenario_json_schema();

}  // namespace linewright
