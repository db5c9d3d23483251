#pragma once

#include <string>

#include "linewright/evaluation/routes_svg.hpp"
#include "routes_view.hpp"

namespace linewright::routes {

/// Height of a panel's title above the hall, pixels.
inline constexpr double kTitleHeight = 26.0;

/// Colours for goals; goals beyond look like earlier ones, and their names differ.
[[nodiscard]] std::size_t style_of_goal(std::size_t goal);

/// Title, hall (the element `lw-hall`), routes, stations and names; view.height + kTitleHeight
/// high.
[[nodiscard]] std::string panel_svg(const Scenario& scenario, const RoutesPanel& panel,
                                    const View& view);

}  // namespace linewright::routes
