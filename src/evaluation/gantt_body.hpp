#pragma once

#include <string>

#include "linewright/evaluation/gantt.hpp"

namespace linewright::gantt {

/// The part of a chart that has a time axis: axis, rows, milestones. Sizes in pixels.
struct BodyOptions {
  double plot_width = 1300.0;
  bool all_labels = false;  ///< also those that do not fit, hidden: a script may show them
};

struct Body {
  std::string svg;  ///< to stand in an `<svg>` of this size, with the chart's style sheet
  double width = 0.0;
  double height = 0.0;
  double gutter = 0.0;  ///< width of the names left of the plot
  double right = 0.0;   ///< width of the column right of it
};

[[nodiscard]] Body draw_body(const GanttChart& chart, const BodyOptions& options);

}  // namespace linewright::gantt
