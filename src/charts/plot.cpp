#include "plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "linewright/base/markup.hpp"

namespace linewright::charts {
namespace {

constexpr double kLeastHeight = 150.0;  // of the plot: a large legend makes the chart higher
constexpr double kTitleRoom = 22.0;     // of an axis title
constexpr double kTickRoom = 8.0;       // between labels and the plot
constexpr double kTickHeight = 32.0;    // between ticks, about

}  // namespace

double room_below(std::string_view title, double labels) {
  return 7.0 + labels + (title.empty() ? 0.0 : kTitleRoom + 3.0) + kMargin - 2.0;
}

Plot lay_out(const ChartFrame& frame, double top, double below, const Range& data,
             const ChartAxis& axis) {
  Plot plot;
  plot.box.top = top + 12.0;
  plot.box.bottom = std::max(frame.height - below, plot.box.top + kLeastHeight);
  plot.height = plot.box.bottom + below;
  plot.box.left = kMargin;
  plot.box.right = frame.width - kMargin - 4.0;
  plot.y_title = axis.title;
  if (!axis.title.empty()) plot.box.left += kTitleRoom;
  if (data.empty()) return plot;
  const double most = plot.box.height() / kTickHeight;
  plot.y = make_ticks(data, axis, AxisEnd::kTick, static_cast<std::size_t>(std::max(2.0, most)));
  plot.y_labels = tick_labels(plot.y, markup::shortened(axis.unit, 60.0, kTickSize));
  double widest = 0.0;
  for (const std::string& label : plot.y_labels) {
    widest = std::max(widest, markup::text_width(label, kTickSize));
  }
  plot.box.left += widest + kTickRoom;
  return plot;
}

std::string draw_grid(const Plot& plot) {
  std::string svg;
  for (std::size_t i = 0; i < plot.y_labels.size(); ++i) {
    const double y = plot.at_y(plot.y.values[i]);
    svg += line("lw-grid", {plot.box.left, y}, {plot.box.right, y});
  }
  return svg;
}

std::string draw_value_axis(const Plot& plot) {
  std::string svg;
  for (std::size_t i = 0; i < plot.y_labels.size(); ++i) {
    svg += text("lw-tick-y lw-end lw-muted",
                {plot.box.left - kTickRoom, plot.at_y(plot.y.values[i]) + 5.0}, plot.y_labels[i]);
  }
  if (plot.y_title.empty()) return svg;
  const double middle = (plot.box.top + plot.box.bottom) / 2.0;
  const std::string title = markup::shortened(plot.y_title, plot.height - 2.0 * kMargin, kTickSize);
  // Kept within the chart where it is longer than the plot.
  const double half = markup::text_width(title, kTickSize) / 2.0;
  const double y = std::clamp(middle, half + 4.0, std::max(half + 4.0, plot.height - half - 4.0));
  return svg + fmt::format("<g transform=\"translate({}) rotate(-90)\">{}</g>\n",
                           pair({kMargin + 12.0, y}), text("lw-mid lw-ink", {}, title));
}

std::string draw_base_line(const Plot& plot) {
  const double base = plot.at_y(std::clamp(0.0, plot.y.low, plot.y.high));
  const bool inside = plot.shows(0.0) && !plot.y_labels.empty();
  const double y = inside ? base : plot.box.bottom;
  return line("lw-axis", {plot.box.left, y}, {plot.box.right, y});
}

std::string draw_bottom_title(const ChartFrame& frame, const Plot& plot, std::string_view title) {
  if (title.empty()) return "";
  const std::string words = markup::shortened(title, frame.width - 2.0 * kMargin, kTickSize);
  const double half = markup::text_width(words, kTickSize) / 2.0;
  const double middle = (plot.box.left + plot.box.right) / 2.0;
  const double x = std::clamp(middle, half + 4.0, std::max(half + 4.0, frame.width - half - 4.0));
  return text("lw-mid lw-ink", {x, plot.height - kMargin - 2.0}, words);
}

std::string draw_no_data(const Box& box) {
  return text("lw-none lw-mid lw-muted",
              {(box.left + box.right) / 2.0, (box.top + box.bottom) / 2.0 + 6.0}, "no data");
}

}  // namespace linewright::charts
