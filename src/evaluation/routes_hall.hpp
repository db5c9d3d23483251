#pragma once

#include <string>

#include "routes_view.hpp"

namespace linewright::routes {

/// Floor, occupied cells and obstacles, without names: the same in all panels. Cells are drawn only
/// where a map file says them; those smaller than a pixel are drawn together.
[[nodiscard]] std::string hall_svg(const HallMap& map, const View& view);

}  // namespace linewright::routes
