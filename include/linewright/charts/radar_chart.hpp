#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "linewright/charts/chart.hpp"

namespace linewright {

struct RadarSeries {
  std::string name;  ///< empty: not in the legend
  std::size_t style = 0;
  std::vector<double> values;  ///< one per axis; what lacks at the end is missing
};

/// One axis per crew or metric, around a centre, all on the same scale; e.g. the improvement over a
/// method to compare with. Readable up to about twelve axes and eight series.
struct RadarChart {
  ChartFrame frame;
  std::vector<std::string> axes;  ///< clockwise from the top
  ChartAxis scale;                ///< `low` is at the centre; the title stands below
  std::vector<RadarSeries> series;
  std::optional<double> base;  ///< a ring at this value, e.g. 1.0 or 0 %
  std::string base_name;       ///< of the ring in the legend
};

/// Without any value the chart says "no data".
[[nodiscard]] std::string radar_chart_svg(const RadarChart& chart);

}  // namespace linewright
