#pragma once

#include <cstddef>
#include <optional>

#include "linewright/scenario/scenario.hpp"

namespace linewright::cli {

/// What it takes to have the routes of a scenario.
struct RouteTimes {
  double cold_ms = 0.0;    ///< to plan all of them: distance field and search, wall clock
  double cached_ms = 0.0;  ///< to take them from a cache file: key, reading, checking; the median
  std::size_t readings = 0;
  std::size_t bytes = 0;  ///< of the cache file
  std::size_t threads = 0;
};

/// Plans the routes in Scenario::routes again and reads them from a temporary file. None when
/// interrupted. `threads` 0: one per core. Reports to the user when the routes that the scenario
/// was loaded with are not those that are planned now.
[[nodiscard]] std::optional<RouteTimes> time_routes(const Scenario& scenario, std::size_t threads);

}  // namespace linewright::cli
