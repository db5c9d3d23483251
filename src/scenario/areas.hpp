#pragma once

#include <optional>
#include <string>

#include "build_state.hpp"
#include "linewright/map/polygon.hpp"

// Areas of the floor as they are written in a scenario. Each reports what is wrong with it under
// `title`; none then, and none for what was reported already.
namespace linewright::loading {

/// [x0, x1, y0, y1].
[[nodiscard]] std::optional<Rectangle> read_rectangle(BuildState& state, const SourceNode& node,
                                                      const std::string& title);

/// [[x, y], ...] in either direction; counter-clockwise afterwards.
[[nodiscard]] std::optional<Polygon> read_polygon(BuildState& state, const SourceNode& node,
                                                  const std::string& title);

/// [x0, x1, y0, y1], or a mapping with `rectangle` or `polygon`.
[[nodiscard]] std::optional<Polygon> read_area(BuildState& state, const SourceNode& node,
                                               const std::string& title);

}  // namespace linewright::loading
