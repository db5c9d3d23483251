#include "linewright/charts/radar_chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "drawing.hpp"
#include "head.hpp"
#include "line_paths.hpp"
#include "linewright/base/markup.hpp"
#include "plot.hpp"
#include "ticks.hpp"

namespace linewright {
namespace {

using charts::Point;
using charts::style_class;

constexpr double kLabelGap = 10.0;      // between the outer ring and the axes' names
constexpr double kWidestLabel = 150.0;  // of an axis
constexpr double kLeastRadius = 70.0;
constexpr double kRingGap = 34.0;  // about

std::size_t shown_values(const RadarChart& chart, const RadarSeries& series) {
  return std::min(series.values.size(), chart.axes.size());
}

charts::Range extent_of(const RadarChart& chart) {
  charts::Range range;
  for (const RadarSeries& series : chart.series) {
    for (std::size_t i = 0; i < shown_values(chart, series); ++i) range.add(series.values[i]);
  }
  return range;
}

std::vector<charts::LegendEntry> legend_of(const RadarChart& chart) {
  std::vector<charts::LegendEntry> legend;
  for (const RadarSeries& series : chart.series) {
    const auto look =
        "lw-line " + style_class('s', series.style) + " " + style_class('d', series.style);
    legend.push_back({charts::line(look, {}, {charts::kSampleWidth, 0.0}) +
                          charts::marker(series.style, {charts::kSampleWidth / 2.0, 0.0}),
                      series.name});
  }
  if (chart.base && charts::usable(*chart.base)) {
    legend.push_back({charts::line(charts::reference_look(0, {}), {}, {charts::kSampleWidth, 0.0}),
                      chart.base_name});
  }
  return legend;
}

/// The web that the series are drawn into.
class Web {
 public:
  Web(const RadarChart& chart, const ChartFrame& frame, double top) : chart_(chart) {
    const double line = charts::kTickSize + kLabelGap;
    double widest = 0.0;
    for (const std::string& name : chart.axes) {
      names_.push_back(markup::shortened(name, kWidestLabel, charts::kTickSize));
      widest = std::max(widest, markup::text_width(names_.back(), charts::kTickSize));
    }
    const double below = charts::kMargin + (chart.scale.title.empty() ? 0.0 : 24.0);
    const double across = frame.width / 2.0 - charts::kMargin - widest - kLabelGap;
    const double down = (frame.height - top - below) / 2.0 - line;
    radius_ = std::max(kLeastRadius, std::min(across, down));
    centre_ = {frame.width / 2.0, top + 4.0 + line + radius_};
    height_ = std::max(frame.height, centre_.y + radius_ + line + below);
    // Room that the radius leaves over is shared by above and below.
    centre_.y += (height_ - (centre_.y + radius_ + line + below)) / 2.0;
  }

  void scale_to(charts::Range range) {
    if (chart_.base) range.add(*chart_.base);
    const double most = std::max(2.0, radius_ / kRingGap);
    ticks_ = charts::make_ticks(range, chart_.scale, charts::AxisEnd::kTick,
                                static_cast<std::size_t>(most));
  }

  [[nodiscard]] double height() const { return height_; }

  [[nodiscard]] charts::Box box() const {
    return {centre_.x - radius_, centre_.y - radius_, centre_.x + radius_, centre_.y + radius_};
  }

  /// Rings and axes.
  [[nodiscard]] std::string draw() const {
    std::string svg;
    for (const double value : ticks_.values) svg += ring("lw-grid", value);
    for (std::size_t i = 0; i < names_.size(); ++i) {
      svg += charts::line("lw-grid", centre_, place(i, ticks_.high));
    }
    return svg;
  }

  [[nodiscard]] std::string draw_base() const {
    return chart_.base ? ring(charts::reference_look(0, {}), *chart_.base) : "";
  }

  /// Names of the axes, and the numbers of the rings where they hide least.
  [[nodiscard]] std::string draw_labels() const {
    std::string svg;
    for (std::size_t i = 0; i < names_.size(); ++i) svg += name(i);
    const auto labels =
        charts::tick_labels(ticks_, markup::shortened(chart_.scale.unit, 60.0, charts::kTickSize));
    const std::size_t gap = emptiest_gap(labels);
    for (std::size_t i = 0; i < labels.size(); ++i) {
      const Point p = middle(gap, ticks_.values[i]);
      svg += charts::text("lw-tick-y lw-mid lw-halo lw-muted", {p.x, p.y + 5.0}, labels[i]);
    }
    return svg;
  }

  /// The series as a closed line, or where values are missing as what is left of it.
  [[nodiscard]] std::string draw(const RadarSeries& series) const {
    const std::size_t count = names_.size();
    std::string path;
    std::string markers;
    bool whole = true;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t next = (i + 1) % count;
      whole = whole && has(series, i);
      if (!has(series, i)) continue;
      const Point p = place(i, series.values[i]);
      markers += charts::marker(series.style, p, tip_of(series, i));
      if (i == 0 || !has(series, i - 1)) path += "M" + charts::pair(p);
      if (!has(series, next)) continue;
      if (next != 0) path += "L" + charts::pair(place(next, series.values[next]));
      if (next == 0 && !whole) path += "L" + charts::pair(place(0, series.values[0]));
    }
    if (whole) path += "Z";
    const std::string area = fmt::format("<path class=\"lw-area {}\" d=\"{}\"/>\n",
                                         style_class('f', series.style), path);
    return (whole ? area : "") +
           fmt::format("<path class=\"lw-line {} {}\" d=\"{}\"/>\n", style_class('s', series.style),
                       style_class('d', series.style), path) +
           markers;
  }

 private:
  [[nodiscard]] bool has(const RadarSeries& series, std::size_t axis) const {
    return axis < shown_values(chart_, series) && charts::usable(series.values[axis]);
  }

  /// On a ring, between an axis and the next.
  [[nodiscard]] Point middle(std::size_t axis, double value) const {
    const Point a = place(axis, value);
    const Point b = place((axis + 1) % names_.size(), value);
    return {(a.x + b.x) / 2.0, (a.y + b.y) / 2.0};
  }

  /// All lines of the series, in small boxes.
  [[nodiscard]] std::vector<charts::Box> data() const {
    std::vector<charts::Box> boxes;
    for (const RadarSeries& series : chart_.series) {
      for (std::size_t i = 0; i < names_.size(); ++i) {
        const std::size_t next = (i + 1) % names_.size();
        if (!has(series, i) || !has(series, next)) continue;
        charts::add_boxes({place(i, series.values[i]), place(next, series.values[next])}, boxes);
      }
    }
    return boxes;
  }

  /// The axis before the gap whose numbers would meet the least of the data.
  [[nodiscard]] std::size_t emptiest_gap(const std::vector<std::string>& labels) const {
    const std::vector<charts::Box> boxes = data();
    std::size_t best = 0;
    std::size_t least = boxes.size() * labels.size() + 1;
    for (std::size_t gap = 0; gap < names_.size(); ++gap) {
      std::size_t met = 0;
      for (std::size_t i = 0; i < labels.size(); ++i) {
        const Point p = middle(gap, ticks_.values[i]);
        const double half = markup::text_width(labels[i], charts::kTickSize) / 2.0 + 1.0;
        const charts::Box box{p.x - half, p.y - 7.0, p.x + half, p.y + 7.0};
        met += static_cast<std::size_t>(
            std::count_if(boxes.begin(), boxes.end(),
                          [&](const charts::Box& other) { return box.meets(other); }));
      }
      if (met < least) best = gap;
      least = std::min(least, met);
    }
    return best;
  }

  /// From the centre to the end of an axis, as long as 1.
  [[nodiscard]] Point direction(std::size_t axis) const {
    const double turn = static_cast<double>(axis) / static_cast<double>(names_.size());
    const double angle = 2.0 * std::numbers::pi * turn;
    return {std::sin(angle), -std::cos(angle)};
  }

  /// Values off the scale stand at its ends.
  [[nodiscard]] Point place(std::size_t axis, double value) const {
    const Point towards = direction(axis);
    const double far = radius_ * std::clamp(ticks_.share(value), 0.0, 1.0);
    return {centre_.x + towards.x * far, centre_.y + towards.y * far};
  }

  [[nodiscard]] std::string ring(const std::string& look, double value) const {
    if (value < ticks_.low || value > ticks_.high) return "";
    std::string path;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      path += (path.empty() ? "M" : "L") + charts::pair(place(i, value));
    }
    return fmt::format("<path class=\"{}\" d=\"{}Z\"/>\n", look, path);
  }

  [[nodiscard]] std::string name(std::size_t axis) const {
    const Point towards = direction(axis);
    const double far = radius_ + kLabelGap;
    // Up and down the names stand in the middle above and below, else beside.
    const bool beside = std::abs(towards.x) > 0.1;
    const char* look = !beside           ? "lw-axis-name lw-mid lw-ink"
                       : towards.x < 0.0 ? "lw-axis-name lw-end lw-ink"
                                         : "lw-axis-name lw-ink";
    const double lift = 5.0 + towards.y * 5.0;
    return charts::text(look, {centre_.x + towards.x * far, centre_.y + towards.y * far + lift},
                        names_[axis]);
  }

  [[nodiscard]] std::string tip_of(const RadarSeries& series, std::size_t axis) const {
    return fmt::format("{}{}{}: {}", chart_.axes[axis], series.name.empty() ? "" : " · ",
                       series.name, charts::value_text(series.values[axis], chart_.scale.unit));
  }

  const RadarChart& chart_;
  std::vector<std::string> names_;
  double radius_ = 0.0;
  Point centre_;
  double height_ = 0.0;
  charts::Ticks ticks_;
};

std::string draw_title(const RadarChart& chart, const ChartFrame& frame, double height) {
  if (chart.scale.title.empty()) return "";
  const double room = frame.width - 2.0 * charts::kMargin;
  return charts::text("lw-mid lw-ink", {frame.width / 2.0, height - charts::kMargin},
                      markup::shortened(chart.scale.title, room, charts::kTickSize));
}

}  // namespace

std::string radar_chart_svg(const RadarChart& chart) {
  const ChartFrame frame = charts::sound(chart.frame);
  const charts::Range range = extent_of(chart);
  const bool empty = range.empty();
  const charts::Head head =
      charts::draw_head(frame, empty ? std::vector<charts::LegendEntry>{} : legend_of(chart));
  Web web(chart, frame, head.bottom);
  std::string body = head.svg + draw_title(chart, frame, web.height());
  if (empty) return charts::document(frame, web.height(), body + charts::draw_no_data(web.box()));
  web.scale_to(range);
  body += web.draw() + web.draw_base();
  for (const RadarSeries& series : chart.series) body += web.draw(series);
  return charts::document(frame, web.height(), body + web.draw_labels());
}

}  // namespace linewright
