#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "build_state.hpp"

namespace linewright::loading {

/// Ticks a worker of the kind needs for the way, rounded up; reports when that is out of range.
[[nodiscard]] std::optional<Tick> ticks_for(BuildState& state, std::size_t kind, double metres,
                                            SourceMark mark);

/// A kind of worker whose routes are planned on the map.
struct RoutedKind {
  std::size_t kind = 0;
  std::string planner;  ///< one of path_planner_names()
  SourceMark mark;      ///< where that was said
};

/// Plans the routes of these kinds, or takes them from the cache: fills their travel tables,
/// Scenario::routes and LineModel::ways. Reports stations where a worker cannot stand.
void fill_from_routes(BuildState& state, const std::vector<RoutedKind>& kinds);

}  // namespace linewright::loading
