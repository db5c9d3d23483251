#pragma once

#include <string>

#include "routes_view.hpp"

namespace linewright::routes {

/// Floor, occupied cells and obstacles, without names: the same in all panels. Cells are drawn only
/// where a map file says them; those smaller than a pixel are drawn together.
[[nodiscard]] std::string hall_svg(const HallMap& map, const View& view);

/// The same from its parts: `cells` is drawn on the floor below the obstacles (path data).
[[nodiscard]] std::string floor_svg(const Polygon& floor, const std::string& cells,
                                    const std::string& obstacles, const View& view);

/// A round length, about a fifth of the hall, as a bar 22 pixels high that ends at `right`.
[[nodiscard]] std::string scale_bar(const View& view, double right);

}  // namespace linewright::routes
