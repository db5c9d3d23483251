#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "linewright/scenario/scenario.hpp"

namespace linewright {

/// One panel of the picture: the routes of one kind of worker from one station to all others.
struct RoutesPanel {
  std::size_t kind = 0;   ///< worker kind; Scenario::routes must be there for it
  std::size_t start = 0;  ///< stop of its RouteRequest
};

/// What the picture shows unless told otherwise: two starts of every kind with routes, in the order
/// of the stops (one where it has a single stop, none where it has none). They are the two with the
/// largest sum of: the route between them, and for each the mean and the standard deviation of the
/// lengths of all routes from it, all in metres; a route that was not found counts as none. So they
/// lie far apart, and their routes are long and varied. Ties: the first.
[[nodiscard]] std::vector<RoutesPanel> showcase_panels(const Scenario& scenario);

/// One SVG without scripts, fonts or links, light or dark as the viewer prefers: for each panel the
/// hall to scale with its obstacles, the stations of the kind, and the routes as the exact straight
/// pieces and arcs that are driven, a colour for each goal, backwards pieces dashed, goals without
/// a route crossed out. One `<g class="route">` per route. The same bytes for the same scenario.
/// The scenario must have a map, and `panels` must be valid and not empty.
[[nodiscard]] std::string routes_svg(const Scenario& scenario,
                                     const std::vector<RoutesPanel>& panels);

}  // namespace linewright
