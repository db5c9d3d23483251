#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "linewright/charts/chart.hpp"

namespace linewright {

struct LinePoint {
  double x = 0.0;
  double y = 0.0;
  double y_low = kMissing;   ///< of the band, e.g. a 95 % interval over training seeds
  double y_high = kMissing;  ///< of the band; one without the other counts as missing
};

struct LineSeries {
  std::string name;  ///< empty: not in the legend
  std::size_t style = 0;
  std::vector<LinePoint> points;  ///< joined in this order
  bool markers = false;           ///< marks the points, as many as have room
};

/// Several series over one axis of numbers.
struct LineChart {
  ChartFrame frame;
  ChartAxis x;
  ChartAxis y;
  std::vector<LineSeries> series;  ///< later ones are drawn over earlier ones
  std::vector<ReferenceLine> references;
};

/// Without any point the chart says "no data".
[[nodiscard]] std::string line_chart_svg(const LineChart& chart);

}  // namespace linewright
