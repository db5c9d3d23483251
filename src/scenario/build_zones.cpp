#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "build_state.hpp"
#include "linewright/map/polygon.hpp"
#include "values.hpp"

namespace linewright::loading {
namespace {

double number(const SourceNode& node) { return parse_real(node.text).value_or(0.0); }

Polygon corners(const SourceNode& node) {
  Polygon polygon;
  for (const SourceNode& corner : node.items) {
    if (corner.is_list()) polygon.push_back({number(corner.items[0]), number(corner.items[1])});
  }
  return polygon;
}

/// The zone's outline, counter-clockwise; reports when it has none or encloses nothing.
Polygon outline(BuildState& state, const SourceNode& node, const std::string& title) {
  if (!node.sound) return {};  // what was written is wrong and was reported
  const SourceNode* rectangle = node.find("rectangle");
  const SourceNode* polygon = node.find("polygon");
  if ((rectangle == nullptr) == (polygon == nullptr)) {
    state.problems.error(node.mark,
                         fmt::format("{}: {}", title,
                                     polygon == nullptr ? "it has neither a rectangle nor a polygon"
                                                        : "it has a rectangle and a polygon"),
                         "write rectangle: [x0, x1, y0, y1] or polygon: [[x, y], ...]");
    return {};
  }
  if (polygon != nullptr) {
    Polygon made = corners(*polygon);
    if (const auto fault = polygon_fault(made)) {
      state.problems.error(polygon->mark, fmt::format("{}: the polygon: {}", title, *fault),
                           "list the corners in order around it");
    }
    if (doubled_area_m2(made) < 0.0) std::reverse(made.begin(), made.end());
    return made;
  }
  if (!rectangle->is_list()) return {};
  const auto& n = rectangle->items;
  const Rectangle made{number(n[0]), number(n[1]), number(n[2]), number(n[3])};
  if (!(made.x0_m < made.x1_m && made.y0_m < made.y1_m)) {
    state.problems.error(rectangle->mark, fmt::format("{}: the rectangle has no area", title),
                         "write [x0, x1, y0, y1] with x0 < x1 and y0 < y1");
  }
  return corners_of(made);
}

/// Ascending and disjoint, whatever the file's order; what overlaps or touches is one.
std::vector<std::pair<Tick, Tick>> spans(const SourceNode& node) {
  std::vector<std::pair<Tick, Tick>> read;
  const SourceNode* closed = node.find("closed");
  if (closed == nullptr) return read;
  for (const SourceNode& item : closed->items) {
    if (!item.is_list()) continue;
    const auto tick = static_cast<Tick>(parse_integer(item.items[0].text).value_or(1));
    read.emplace_back(tick,
                      tick + static_cast<Tick>(parse_integer(item.items[1].text).value_or(1)));
  }
  std::sort(read.begin(), read.end());
  std::vector<std::pair<Tick, Tick>> joined;
  for (const auto& [first, open] : read) {
    if (!joined.empty() && first <= joined.back().second) {
      joined.back().second = std::max(joined.back().second, open);
    } else {
      joined.emplace_back(first, open);
    }
  }
  return joined;
}

}  // namespace

void build_zones(BuildState& state) {
  state.each(Section::kZones, [&](std::int32_t id, const SourceNode& node) {
    const std::string title = state.names.title(Section::kZones, id);
    state.line().zones.push_back({state.names.names(Section::kZones)[static_cast<std::size_t>(id)],
                                  outline(state, node, title), spans(node)});
  });
}

}  // namespace linewright::loading
