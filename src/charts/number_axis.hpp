#pragma once

#include <string>
#include <vector>

#include "drawing.hpp"
#include "linewright/charts/chart.hpp"
#include "ticks.hpp"

// The axis of numbers at the bottom of a plot.
namespace linewright::charts {

struct NumberAxis {
  Ticks ticks;
  std::vector<std::string> labels;
  double left = 0.0;  ///< where the axis shows ticks.low
  double right = 0.0;

  [[nodiscard]] double at_x(double value) const {
    return left + ticks.share(value) * (right - left);
  }
};

/// An axis along the bottom of `plot`, with so few ticks that their labels keep apart. Makes the
/// plot narrower where the last label would leave the chart.
[[nodiscard]] NumberAxis make_number_axis(const ChartAxis& axis, const Range& data, Box& plot);

/// Tick marks and labels.
[[nodiscard]] std::string draw_number_axis(const NumberAxis& axis, const Box& plot);

}  // namespace linewright::charts
