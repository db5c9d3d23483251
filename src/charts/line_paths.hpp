#pragma once

#include <string>
#include <vector>

#include "drawing.hpp"

// The shapes of one series of a line chart.
namespace linewright::charts {

/// A stretch of points without a gap.
using Run = std::vector<Point>;

/// The points of a run that show: where many fall into one column of half a unit, only its first,
/// lowest, highest and last. The line looks the same, in a file that does not grow with the data.
[[nodiscard]] Run thinned(const Run& run);

/// "M… L…" through the points.
[[nodiscard]] std::string path_of(const Run& run);

/// What a label must not hide of a line: boxes along it, each a few units long.
void add_boxes(const Run& run, std::vector<Box>& boxes);

}  // namespace linewright::charts
