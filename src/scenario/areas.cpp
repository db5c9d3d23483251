#include "areas.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "linewright/scenario/values.hpp"

namespace linewright::loading {

std::optional<Rectangle> read_rectangle(BuildState& state, const SourceNode& node,
                                        const std::string& title) {
  if (!node.is_list()) return std::nullopt;
  const auto number = [&](std::size_t i) { return parse_real(node.items[i].text).value_or(0.0); };
  const Rectangle r{number(0), number(1), number(2), number(3)};
  if (r.x0_m < r.x1_m && r.y0_m < r.y1_m) return r;
  state.problems.error(node.mark, fmt::format("{}: the rectangle has no area", title),
                       "write [x0, x1, y0, y1] with x0 < x1 and y0 < y1");
  return std::nullopt;
}

std::optional<Polygon> read_polygon(BuildState& state, const SourceNode& node,
                                    const std::string& title) {
  if (!node.is_list() || !node.sound) return std::nullopt;
  Polygon corners;
  for (const SourceNode& corner : node.items) {
    corners.push_back({parse_real(corner.items[0].text).value_or(0.0),
                       parse_real(corner.items[1].text).value_or(0.0)});
  }
  if (const auto fault = polygon_fault(corners)) {
    state.problems.error(node.mark, fmt::format("{}: not a simple polygon: {}", title, *fault),
                         "give the corners in the order in which one walks around it");
    return std::nullopt;
  }
  if (doubled_area_m2(corners) < 0.0) std::reverse(corners.begin(), corners.end());
  return corners;
}

std::optional<Polygon> read_area(BuildState& state, const SourceNode& node,
                                 const std::string& title) {
  if (const SourceNode* corners = node.find("polygon")) return read_polygon(state, *corners, title);
  const SourceNode* sides = node.is_list() ? &node : node.find("rectangle");
  const auto r = sides != nullptr ? read_rectangle(state, *sides, title) : std::nullopt;
  return r ? std::optional(corners_of(*r)) : std::nullopt;
}

}  // namespace linewright::loading
