#pragma once

#include <cstddef>
#include <string>

namespace linewright::routes {

/// CSS for pictures of the hall: that of charts (gantt_style.hpp) with so many colours, and floor,
/// obstacles, ways, stations and names. Light and, where the viewer prefers it, dark.
[[nodiscard]] std::string style_sheet(std::size_t colours = 12);

}  // namespace linewright::routes
