#pragma once

#include <optional>
#include <vector>

#include "linewright/routing/map_ways.hpp"
#include "travel.hpp"

namespace linewright::loading {

/// What the routes of the kind follow from; without the routes.
[[nodiscard]] KindRoutes route_request(const BuildState& state, const RoutedKind& kind);

/// Reports stations where the kind collides, that lie outside of the map, or that share one place,
/// and a footprint that is larger than the hall. True when nothing was reported.
[[nodiscard]] bool check_stops(BuildState& state, const KindRoutes& kind, const RoutedKind& routed,
                               const std::shared_ptr<const ClearanceMap>& map);

}  // namespace linewright::loading
