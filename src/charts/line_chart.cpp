#include "linewright/charts/line_chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "drawing.hpp"
#include "head.hpp"
#include "line_paths.hpp"
#include "linewright/base/markup.hpp"
#include "number_axis.hpp"
#include "plot.hpp"
#include "references.hpp"
#include "ticks.hpp"

namespace linewright {
namespace {

using charts::Box;
using charts::Point;
using charts::Run;
using charts::style_class;

constexpr double kMarkerGap = 26.0;  // least distance between markers of one series

bool has_point(const LinePoint& point) {
  return charts::usable(point.x) && charts::usable(point.y);
}

bool has_band(const LinePoint& point) {
  return has_point(point) && charts::usable(point.y_low) && charts::usable(point.y_high);
}

/// What the axes must cover.
struct Extent {
  charts::Range x;
  charts::Range y;
};

Extent extent_of(const LineChart& chart) {
  Extent extent;
  for (const LineSeries& series : chart.series) {
    for (const LinePoint& point : series.points) {
      if (!has_point(point)) continue;
      extent.x.add(point.x);
      extent.y.add(point.y);
      if (!has_band(point)) continue;
      extent.y.add(point.y_low);
      extent.y.add(point.y_high);
    }
  }
  return extent;
}

std::vector<charts::LegendEntry> legend_of(const LineChart& chart) {
  std::vector<charts::LegendEntry> legend;
  for (const LineSeries& series : chart.series) {
    const auto look =
        "lw-line " + style_class('s', series.style) + " " + style_class('d', series.style);
    std::string sample = charts::line(look, {}, {charts::kSampleWidth, 0.0});
    if (series.markers) sample += charts::marker(series.style, {charts::kSampleWidth / 2.0, 0.0});
    legend.push_back({sample, series.name});
  }
  return legend;
}

/// Draws the series into a plot.
class Painter {
 public:
  Painter(const LineChart& chart, const charts::Plot& plot, const charts::NumberAxis& x)
      : chart_(chart), plot_(plot), x_(x) {
    for (const LineSeries& series : chart.series) add_line(series);
  }

  [[nodiscard]] std::string bands() const {
    std::string svg;
    for (const LineSeries& series : chart_.series) svg += band(series);
    return svg;
  }

  [[nodiscard]] const std::string& lines() const { return lines_; }
  [[nodiscard]] const std::string& markers() const { return markers_; }
  [[nodiscard]] const std::vector<Box>& boxes() const { return boxes_; }

 private:
  [[nodiscard]] Point place(double x, double y) const { return {x_.at_x(x), plot_.at_y(y)}; }

  /// The series without its gaps.
  [[nodiscard]] std::vector<Run> runs_of(const LineSeries& series) const {
    std::vector<Run> runs;
    bool gap = true;
    for (const LinePoint& point : series.points) {
      if (has_point(point)) {
        if (gap) runs.emplace_back();
        runs.back().push_back(place(point.x, point.y));
      }
      gap = !has_point(point);
    }
    return runs;
  }

  void add_line(const LineSeries& series) {
    std::string path;
    for (const Run& run : runs_of(series)) {
      const Run shown = charts::thinned(run);
      charts::add_boxes(shown, boxes_);
      path += charts::path_of(shown);
      // A line of one point would not show.
      if (run.size() == 1 && !series.markers) add_marker(series, run.front(), "");
    }
    if (series.markers) add_markers(series);
    if (path.empty()) return;
    lines_ += fmt::format("<path class=\"lw-line {} {}\" d=\"{}\"/>\n",
                          style_class('s', series.style), style_class('d', series.style), path);
  }

  void add_markers(const LineSeries& series) {
    Point last{-1e9, 0.0};
    for (const LinePoint& point : series.points) {
      if (!has_point(point)) continue;
      const Point p = place(point.x, point.y);
      if (std::hypot(p.x - last.x, p.y - last.y) < kMarkerGap) continue;
      last = p;
      add_marker(series, p, tip_of(series, point));
    }
  }

  void add_marker(const LineSeries& series, Point p, const std::string& tip) {
    constexpr double kHalf = 6.0;
    constexpr double kEdge = 0.5;  // a point at the end of an axis is within
    const Box& box = plot_.box;
    const Box around{box.left - kEdge, box.top - kEdge, box.right + kEdge, box.bottom + kEdge};
    if (!around.contains(p)) return;
    markers_ += charts::marker(series.style, p, tip);
    boxes_.push_back({p.x - kHalf, p.y - kHalf, p.x + kHalf, p.y + kHalf});
  }

  [[nodiscard]] std::string tip_of(const LineSeries& series, const LinePoint& point) const {
    std::string tip = fmt::format("{}{}{}: {}", series.name, series.name.empty() ? "" : " · ",
                                  charts::value_text(point.x, chart_.x.unit),
                                  charts::value_text(point.y, chart_.y.unit));
    if (!has_band(point)) return tip;
    return tip + fmt::format(" ({} … {})", charts::value_text(point.y_low, chart_.y.unit),
                             charts::value_text(point.y_high, chart_.y.unit));
  }

  /// The band as one path, a closed piece for every stretch without a gap.
  [[nodiscard]] std::string band(const LineSeries& series) const {
    std::string path;
    Run low;
    Run high;
    const auto close = [&] {
      Run edge = charts::thinned(low);
      const Run back = charts::thinned(high);
      edge.insert(edge.end(), back.rbegin(), back.rend());
      if (low.size() > 1) path += charts::path_of(edge) + "Z";
      if (low.size() == 1) path += whisker(low.front(), high.front());
      low.clear();
      high.clear();
    };
    for (const LinePoint& point : series.points) {
      if (!has_band(point)) {
        close();
        continue;
      }
      low.push_back(place(point.x, point.y_low));
      high.push_back(place(point.x, point.y_high));
    }
    close();
    if (path.empty()) return "";
    return fmt::format("<path class=\"lw-band {}\" d=\"{}\"/>\n", style_class('f', series.style),
                       path);
  }

  /// The band of a point alone, which needs a width to show.
  static std::string whisker(Point low, Point high) {
    return charts::path_of({{low.x - 3.0, low.y},
                            {low.x + 3.0, low.y},
                            {high.x + 3.0, high.y},
                            {high.x - 3.0, high.y}}) +
           "Z";
  }

  const LineChart& chart_;
  const charts::Plot& plot_;
  const charts::NumberAxis& x_;
  std::string lines_;
  std::string markers_;
  std::vector<Box> boxes_;
};

/// One way to lay the chart out.
struct Layout {
  charts::Head head;
  charts::Plot plot;
  charts::NumberAxis x;
};

Layout lay_out(const LineChart& chart, const ChartFrame& frame, const Extent& extent,
               const charts::References& references) {
  std::vector<charts::LegendEntry> legend;
  charts::Range y = extent.y;
  if (!extent.x.empty()) {
    legend = legend_of(chart);
    for (const charts::LegendEntry& entry : references.legend()) legend.push_back(entry);
    references.add_to(y);
  }
  Layout layout;
  layout.head = charts::draw_head(frame, legend);
  layout.plot =
      charts::lay_out(frame, layout.head.bottom, charts::room_below(chart.x.title), y, chart.y);
  if (!extent.x.empty()) layout.x = charts::make_number_axis(chart.x, extent.x, layout.plot.box);
  return layout;
}

std::string draw_data(const Layout& layout, const Painter& painter,
                      const charts::References& references) {
  constexpr double kStroke = 2.0;  // half a line shows beyond the ends of the axes
  const Box& box = layout.plot.box;
  const Box around{box.left - kStroke, box.top - kStroke, box.right + kStroke,
                   box.bottom + kStroke};
  return charts::draw_grid(layout.plot) + charts::clipped(around, painter.bands()) +
         references.draw_lines(layout.plot) + charts::draw_number_axis(layout.x, box) +
         charts::draw_base_line(layout.plot) + charts::clipped(around, painter.lines()) +
         painter.markers() + references.labels();
}

}  // namespace

std::string line_chart_svg(const LineChart& chart) {
  const ChartFrame frame = charts::sound(chart.frame);
  const Extent extent = extent_of(chart);
  charts::References references(chart.references);
  while (true) {
    const Layout layout = lay_out(chart, frame, extent, references);
    const std::string around = layout.head.svg + charts::draw_value_axis(layout.plot) +
                               charts::draw_bottom_title(frame, layout.plot, chart.x.title);
    if (extent.x.empty()) {
      return charts::document(frame, layout.plot.height,
                              around + charts::draw_no_data(layout.plot.box));
    }
    const Painter painter(chart, layout.plot, layout.x);
    if (!references.place(layout.plot, painter.boxes())) continue;  // at most once per reference
    return charts::document(frame, layout.plot.height,
                            around + draw_data(layout, painter, references));
  }
}

}  // namespace linewright
