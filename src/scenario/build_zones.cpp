#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "areas.hpp"
#include "build_state.hpp"
#include "linewright/scenario/values.hpp"

namespace linewright::loading {
namespace {

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
  return read_area(state, node, title).value_or(Polygon{});
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
