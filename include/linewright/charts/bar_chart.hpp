#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "linewright/charts/chart.hpp"

namespace linewright {

struct ChartBar {
  double value = kMissing;
  double low = kMissing;        ///< of the error whisker
  double high = kMissing;       ///< of the error whisker; one without the other counts as missing
  double reference = kMissing;  ///< where a small diamond stands, e.g. the paper's value
};

struct BarSeries {
  std::string name;  ///< empty: not in the legend
  std::size_t style = 0;
  std::vector<ChartBar> bars;  ///< one per category; what lacks at the end is missing
};

/// Bars side by side, grouped by category. Very narrow bars lose their hatching: make a chart of
/// more than about 80 bars wider than usual.
struct BarChart {
  ChartFrame frame;
  std::string category_title;
  std::vector<std::string> categories;
  ChartAxis y;  ///< its title says so when bars do not begin at zero
  /// False lets the axis begin near the smallest value: differences show better, but lengths of
  /// bars no longer compare.
  bool from_zero = true;
  std::vector<BarSeries> series;  ///< within a category in this order
  std::string reference_name;     ///< of the diamonds in the legend, e.g. "paper"
  std::vector<ReferenceLine> references;
};

/// Without any bar or diamond the chart says "no data".
[[nodiscard]] std::string bar_chart_svg(const BarChart& chart);

}  // namespace linewright
