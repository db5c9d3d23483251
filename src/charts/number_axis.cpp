#include "number_axis.hpp"

#include <algorithm>

#include "head.hpp"
#include "linewright/base/markup.hpp"

namespace linewright::charts {
namespace {

constexpr double kApart = 12.0;  // least distance between labels
constexpr double kInset = 18.0;  // of counts from the ends of the axis

double half_width(const std::string& label) { return markup::text_width(label, kTickSize) / 2.0; }

bool keep_apart(const NumberAxis& axis) {
  for (std::size_t i = 1; i < axis.labels.size(); ++i) {
    const double gap = axis.at_x(axis.ticks.values[i]) - axis.at_x(axis.ticks.values[i - 1]);
    if (gap < half_width(axis.labels[i]) + half_width(axis.labels[i - 1]) + kApart) return false;
  }
  return true;
}

}  // namespace

NumberAxis make_number_axis(const ChartAxis& axis, const Range& data, Box& plot) {
  const double inset = axis.integer ? kInset : 0.0;
  const double edge = plot.right + kMargin;  // of the chart, nearly
  NumberAxis result;
  for (std::size_t most = 12; most >= 1; --most) {
    result.ticks = make_ticks(data, axis, AxisEnd::kTight, most);
    result.labels = tick_labels(result.ticks, markup::shortened(axis.unit, 60.0, kTickSize));
    result.left = plot.left + inset;
    result.right = plot.right - inset;
    if (!result.labels.empty()) {
      const double beyond =
          result.at_x(result.ticks.values.back()) + half_width(result.labels.back()) - edge;
      result.right -= std::max(0.0, beyond);
    }
    if (keep_apart(result)) break;
  }
  plot.right = result.right + inset;
  return result;
}

std::string draw_number_axis(const NumberAxis& axis, const Box& plot) {
  std::string svg;
  for (std::size_t i = 0; i < axis.labels.size(); ++i) {
    const double x = axis.at_x(axis.ticks.values[i]);
    svg += line("lw-axis", {x, plot.bottom}, {x, plot.bottom + 5.0});
    svg += text("lw-tick-x lw-mid lw-muted", {x, plot.bottom + 7.0 + kTickSize}, axis.labels[i]);
  }
  return svg;
}

}  // namespace linewright::charts
