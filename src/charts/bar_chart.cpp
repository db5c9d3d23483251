#include "linewright/charts/bar_chart.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "category_axis.hpp"
#include "drawing.hpp"
#include "head.hpp"
#include "plot.hpp"
#include "references.hpp"
#include "ticks.hpp"

namespace linewright {
namespace {

using charts::Box;
using charts::style_class;

constexpr double kWidest = 40.0;     // bar
constexpr double kGroupShare = 0.8;  // of a category's width, for its bars

bool has_whisker(const ChartBar& bar) {
  return charts::usable(bar.low) && charts::usable(bar.high);
}

/// Calls `use(category, place of the series, series, bar)` for every bar.
template <typename Use>
void for_each_bar(const BarChart& chart, const Use& use) {
  for (std::size_t s = 0; s < chart.series.size(); ++s) {
    const BarSeries& series = chart.series[s];
    const std::size_t count = std::min(series.bars.size(), chart.categories.size());
    for (std::size_t c = 0; c < count; ++c) use(c, s, series, series.bars[c]);
  }
}

/// What the axis must cover, without the zero from which bars may begin.
charts::Range extent_of(const BarChart& chart) {
  charts::Range range;
  for_each_bar(chart, [&](std::size_t, std::size_t, const BarSeries&, const ChartBar& bar) {
    range.add(bar.value);
    range.add(bar.reference);
    if (!has_whisker(bar)) return;
    range.add(bar.low);
    range.add(bar.high);
  });
  return range;
}

bool has_references(const BarChart& chart) {
  bool found = false;
  for_each_bar(chart, [&](std::size_t, std::size_t, const BarSeries&, const ChartBar& bar) {
    found = found || charts::usable(bar.reference);
  });
  return found;
}

/// Hatchings need some width, or they are noise.
charts::Fill fill_of(const BarChart& chart) {
  constexpr double kLeast = 4.5;
  const double bars = static_cast<double>(chart.categories.size() * chart.series.size());
  const double width = charts::sound(chart.frame).width * 0.85 * kGroupShare / bars;
  return width < kLeast ? charts::Fill::kPlain : charts::Fill::kHatched;
}

std::vector<charts::LegendEntry> legend_of(const BarChart& chart) {
  std::vector<charts::LegendEntry> legend;
  for (const BarSeries& series : chart.series) {
    const Box sample{0.0, -7.0, 24.0, 7.0};
    legend.push_back(
        {charts::bar(series.style, sample, fill_of(chart)), series.name, sample.right});
  }
  if (has_references(chart)) {
    legend.push_back({charts::diamond({6.0, 0.0}, 9.0), chart.reference_name, 12.0});
  }
  return legend;
}

/// Draws the bars into a plot.
class Painter {
 public:
  Painter(const BarChart& chart, const charts::Plot& plot) : chart_(chart), plot_(plot) {
    const double categories = static_cast<double>(chart.categories.size());
    const double series = static_cast<double>(chart.series.size());
    slot_ = plot.box.width() / categories;
    width_ = std::min(kWidest, slot_ * kGroupShare / series);
    group_ = width_ * series;
    for_each_bar(chart, [&](std::size_t c, std::size_t s, const BarSeries& of,
                            const ChartBar& bar) { add(c, s, of, bar); });
  }

  [[nodiscard]] const std::string& bars() const { return bars_; }
  [[nodiscard]] const std::string& whiskers() const { return whiskers_; }
  [[nodiscard]] const std::string& diamonds() const { return diamonds_; }
  [[nodiscard]] const std::vector<Box>& boxes() const { return boxes_; }

 private:
  void add(std::size_t category, std::size_t place, const BarSeries& series, const ChartBar& bar) {
    const double left = plot_.box.left + slot_ * (static_cast<double>(category) + 0.5) -
                        group_ / 2.0 + width_ * static_cast<double>(place);
    const double gap = std::min(1.0, width_ * 0.1);
    const Box column{left + gap, 0.0, left + width_ - gap, 0.0};
    if (charts::usable(bar.value)) add_bar(column, category, series, bar);
    if (has_whisker(bar)) add_whisker(column, bar);
    if (!charts::usable(bar.reference) || !plot_.shows(bar.reference)) return;
    const double x = left + width_ / 2.0;
    const double y = plot_.at_y(bar.reference);
    diamonds_ += charts::diamond({x, y}, width_,
                                 fmt::format("{}: {}", chart_.reference_name,
                                             charts::value_text(bar.reference, chart_.y.unit)));
    boxes_.push_back({x - 5.0, y - 5.0, x + 5.0, y + 5.0});
  }

  void add_bar(const Box& column, std::size_t category, const BarSeries& series,
               const ChartBar& bar) {
    const double base = within(0.0);
    const double end = within(bar.value);
    const Box box{column.left, std::min(base, end), column.right, std::max(base, end)};
    bars_ += charts::bar(series.style, box, fill_of(chart_), tip_of(category, series, bar));
    boxes_.push_back(box);
  }

  /// A whisker that leaves the axis ends there, without a cap.
  void add_whisker(const Box& column, const ChartBar& bar) {
    const double x = (column.left + column.right) / 2.0;
    const double cap = std::min(4.0, column.width() * 0.35);
    const auto [low, high] = std::minmax(bar.low, bar.high);
    std::string path = "M" + charts::pair({x, within(low)}) + "L" + charts::pair({x, within(high)});
    for (const double end : {low, high}) {
      if (!plot_.shows(end)) continue;
      const double y = plot_.at_y(end);
      path += "M" + charts::pair({x - cap, y}) + "L" + charts::pair({x + cap, y});
    }
    // With an edge in the colour of the ground, which shows on dark bars.
    whiskers_ += fmt::format(
        "<path class=\"lw-edge\" d=\"{0}\"/>\n<path class=\"lw-whisker\" d=\"{0}\"/>\n", path);
    boxes_.push_back({x - cap, within(high), x + cap, within(low)});
  }

  /// The height of a value, or of the end of the axis that is nearest to it.
  [[nodiscard]] double within(double value) const {
    return plot_.at_y(std::clamp(value, plot_.y.low, plot_.y.high));
  }

  [[nodiscard]] std::string tip_of(std::size_t category, const BarSeries& series,
                                   const ChartBar& bar) const {
    std::string tip =
        fmt::format("{}{}{}: {}", chart_.categories[category], series.name.empty() ? "" : " · ",
                    series.name, charts::value_text(bar.value, chart_.y.unit));
    if (!has_whisker(bar)) return tip;
    return tip + fmt::format(" ({} … {})", charts::value_text(bar.low, chart_.y.unit),
                             charts::value_text(bar.high, chart_.y.unit));
  }

  const BarChart& chart_;
  const charts::Plot& plot_;
  double slot_ = 0.0;
  double width_ = 0.0;
  double group_ = 0.0;
  std::string bars_;
  std::string whiskers_;
  std::string diamonds_;
  std::vector<Box> boxes_;
};

/// One way to lay the chart out.
struct Layout {
  charts::Head head;
  charts::CategoryAxis categories;
  charts::Plot plot;
};

bool begins_at_zero(const charts::Plot& plot) { return plot.y_labels.empty() || plot.shows(0.0); }

Layout lay_out(const BarChart& chart, const ChartFrame& frame,
               const charts::References& references) {
  charts::Range range = extent_of(chart);
  std::vector<charts::LegendEntry> legend;
  if (!range.empty()) {
    legend = legend_of(chart);
    for (const charts::LegendEntry& entry : references.legend()) legend.push_back(entry);
    references.add_to(range);
  }
  if (chart.from_zero && !range.empty()) range.add(0.0);
  Layout layout;
  layout.head = charts::draw_head(frame, legend);
  ChartAxis axis = chart.y;
  const auto with = [&](double names) {
    return charts::lay_out(frame, layout.head.bottom,
                           charts::room_below(chart.category_title, names), range, axis);
  };
  // The width is nearly that of a plot with level names: only the widths of numbers may differ.
  const Box box = with(charts::kTickSize).box;
  layout.categories = charts::make_category_axis(chart.categories, box.left, box.width());
  layout.plot = with(layout.categories.height);
  if (begins_at_zero(layout.plot)) return layout;
  axis.title += axis.title.empty() ? "axis not from 0" : ", axis not from 0";
  layout.plot = with(layout.categories.height);
  return layout;
}

/// Two strokes across the axis of values, where it leaves out what is between zero and its end.
std::string break_mark(const charts::Plot& plot) {
  if (plot.y.low <= 0.0) return "";
  const double x = plot.box.left;
  const double y = plot.box.bottom;
  std::string svg = charts::line("lw-axis", {x, y}, {x, y - 8.0});
  for (const double up : {8.0, 12.0}) {
    svg += charts::line("lw-axis", {x - 5.0, y - up + 2.5}, {x + 5.0, y - up - 2.5});
  }
  return svg;
}

}  // namespace

std::string bar_chart_svg(const BarChart& chart) {
  const ChartFrame frame = charts::sound(chart.frame);
  const bool empty = extent_of(chart).empty();
  charts::References references(chart.references);
  while (true) {
    const Layout layout = lay_out(chart, frame, references);
    const charts::Plot& plot = layout.plot;
    const std::string around = layout.head.svg + charts::draw_value_axis(plot) +
                               charts::draw_bottom_title(frame, plot, chart.category_title);
    if (empty) {
      return charts::document(frame, plot.height, around + charts::draw_no_data(plot.box));
    }
    const Painter painter(chart, plot);
    if (!references.place(plot, painter.boxes())) continue;  // at most once per reference
    return charts::document(frame, plot.height,
                            around + charts::draw_grid(plot) + painter.bars() +
                                references.draw_lines(plot) + charts::draw_base_line(plot) +
                                break_mark(plot) + painter.whiskers() + painter.diamonds() +
                                charts::draw_category_axis(layout.categories, plot.box) +
                                references.labels());
  }
}

}  // namespace linewright
