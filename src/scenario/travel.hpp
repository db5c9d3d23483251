#pragma once

#include <cstddef>
#include <optional>

#include "build_state.hpp"

namespace linewright::loading {

/// Ticks a worker of the kind needs for the way, rounded up; reports when that is out of range.
[[nodiscard]] std::optional<Tick> ticks_for(BuildState& state, std::size_t kind, double metres,
                                            SourceMark mark);

/// The shortest ways on the map's grid; reports stations that stand in an obstacle and needed ways
/// that do not exist.
void fill_from_grid(BuildState& state, std::size_t kind, SourceMark mark);

}  // namespace linewright::loading
