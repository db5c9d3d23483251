#pragma once

#include "linewright/routing/path.hpp"
#include "steering.hpp"

namespace linewright {

/// Appends a piece; joins it to the last one when they are one movement.
void append_segment(Path& path, const PathSegment& piece);

/// Makes every turn on the spot the shorter one; only for bodies that may turn either way, discs.
void take_short_turns(Path& path);

/// Replaces parts of a path by cheaper connections that are free, from far to near, until a pass
/// gains next to nothing. The path stays free, within its curvature, and keeps its ends (to the
/// last bits). Frame of the grid.
void smooth(Path& path, const Steering& steering, int passes);

}  // namespace linewright
