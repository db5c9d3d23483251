#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "linewright/scenario/scenario.hpp"
#include "route_times.hpp"

// What `linewright routes` prints about the kinds in Scenario::routes.
namespace linewright::cli {

/// A table with a row per kind, the times, and every pair without a route with the reason.
[[nodiscard]] std::string routes_text(const Scenario& scenario, const RouteTimes& times);

/// The same and every route; keys in docs/cli.md.
[[nodiscard]] nlohmann::ordered_json routes_json(const Scenario& scenario, const RouteTimes& times);

}  // namespace linewright::cli
