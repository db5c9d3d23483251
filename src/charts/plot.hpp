#pragma once

#include <string>
#include <vector>

#include "drawing.hpp"
#include "head.hpp"
#include "linewright/charts/chart.hpp"
#include "ticks.hpp"

// A rectangle with an axis of values at its left, for lines and bars.
namespace linewright::charts {

/// Where the data are drawn, and the axis of values.
struct Plot {
  Box box;
  double height = 0.0;  ///< of the whole chart
  Ticks y;
  std::vector<std::string> y_labels;
  std::string y_title;

  [[nodiscard]] double at_y(double value) const {
    return box.bottom - y.share(value) * box.height();
  }
  [[nodiscard]] bool shows(double value) const { return value >= y.low && value <= y.high; }
};

/// Lays the plot out below `top`, with `below` for what stands under it. An empty range gives an
/// axis without ticks.
[[nodiscard]] Plot lay_out(const ChartFrame& frame, double top, double below, const Range& data,
                           const ChartAxis& axis);

/// Lines across the plot at the ticks; to be drawn first.
[[nodiscard]] std::string draw_grid(const Plot& plot);

/// The numbers and the title of the axis of values.
[[nodiscard]] std::string draw_value_axis(const Plot& plot);

/// The line at the bottom, or at zero where that lies within; to be drawn last.
[[nodiscard]] std::string draw_base_line(const Plot& plot);

/// The title under the plot, in the middle of the `below` of lay_out().
[[nodiscard]] std::string draw_bottom_title(const ChartFrame& frame, const Plot& plot,
                                            std::string_view title);

/// Says that there is nothing to show.
[[nodiscard]] std::string draw_no_data(const Box& box);

/// What an axis title and `kTickSize` labels need under a plot.
[[nodiscard]] double room_below(std::string_view title, double labels = kTickSize);

}  // namespace linewright::charts
