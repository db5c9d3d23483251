#include "linewright/charts/line_chart.hpp"

#include <gtest/gtest.h>

#include "linewright/base/markup.hpp"
#include "svg_reader.hpp"

namespace linewright {
namespace {

using test::elements;
using test::numbers;

LineChart small_chart() {
  LineChart chart{.frame = {.title = "Makespan"}, .x = {.title = "steps"}, .y = {.title = "ticks"}};
  LineSeries series{.name = "EBQ-N", .style = 0, .points = {}, .markers = true};
  for (const double x : {0.0, 1000.0, 2500.0, 4000.0}) {
    series.points.push_back({x, 1700.0 - x / 4.0, 1650.0 - x / 4.0, 1750.0 - x / 4.0});
  }
  chart.series.push_back(series);
  return chart;
}

TEST(LineChart, PutsPointsWhereTheAxesSay) {
  const LineChart chart = small_chart();
  const std::string svg = line_chart_svg(chart);
  const test::DrawnAxis x = test::x_axis(svg);
  const test::DrawnAxis y = test::y_axis(svg);
  std::vector<test::Element> markers = elements(svg, "lw-marker");
  markers.erase(markers.begin());  // the legend's
  ASSERT_EQ(markers.size(), 4U);
  const auto path = numbers(elements(svg, "lw-line").back().attributes.at("d"));
  const auto band = numbers(elements(svg, "lw-band").back().attributes.at("d"));
  ASSERT_EQ(path.size(), 8U);
  ASSERT_EQ(band.size(), 16U);
  for (std::size_t i = 0; i < markers.size(); ++i) {
    const LinePoint& point = chart.series[0].points[i];
    const auto place = numbers(markers[i].attributes.at("transform"));
    EXPECT_NEAR(place[0], x.place(point.x), 0.05);
    EXPECT_NEAR(place[1], y.place(point.y), 0.05);
    EXPECT_NEAR(path[2 * i], x.place(point.x), 0.05);
    EXPECT_NEAR(path[2 * i + 1], y.place(point.y), 0.05);
    EXPECT_NEAR(band[2 * i + 1], y.place(point.y_low), 0.05);
    EXPECT_NEAR(band[15 - 2 * i], y.place(point.y_high), 0.05);
  }
}

TEST(LineChart, PutsReferenceLinesAtTheirValues) {
  LineChart chart = small_chart();
  chart.references = {{797.0, "tuned priority list 797", {}}};
  const std::string svg = line_chart_svg(chart);
  const auto lines = elements(svg, "lw-ref");
  ASSERT_EQ(lines.size(), 1U);  // not in the legend: there is room at the line
  EXPECT_NEAR(numbers(lines[0].attributes.at("d"))[1], test::y_axis(svg).place(797.0), 0.05);
  EXPECT_EQ(test::count(svg, "tuned priority list 797"), 1U);
}

TEST(LineChart, NamesCrowdedReferenceLinesInTheLegend) {
  LineChart chart = small_chart();
  for (const double value : {1000.0, 1001.0, 1002.0}) {
    chart.references.push_back({value, "reference", {}});
  }
  const std::string svg = line_chart_svg(chart);
  EXPECT_EQ(test::count(svg, ">reference<"), 3U);
  EXPECT_GT(elements(svg, "lw-ref").size(), 3U);
  EXPECT_LE(test::legend_bottom(svg), test::plot_top(svg));
}

TEST(LineChart, LeavesGapsForMissingPoints) {
  LineChart chart = small_chart();
  chart.series[0].points[1].y = kMissing;
  const std::string svg = line_chart_svg(chart);
  const std::string path = elements(svg, "lw-line").back().attributes.at("d");
  EXPECT_EQ(test::count(path, "M"), 2U);
  EXPECT_EQ(numbers(path).size(), 6U);
  EXPECT_EQ(elements(svg, "lw-marker").size(), 4U);  // one in the legend
  EXPECT_EQ(test::chart_fault(svg), "");
}

TEST(LineChart, ShowsAPointThatStandsAlone) {
  LineChart chart = small_chart();
  chart.series[0].markers = false;
  chart.series[0].points[1].y = kMissing;  // leaves the first alone
  EXPECT_EQ(elements(line_chart_svg(chart), "lw-marker").size(), 1U);
}

TEST(LineChart, CutsOffWhatTheAxisDoesNotShow) {
  LineChart chart = small_chart();
  chart.y.high = 1500.0;
  chart.y.low = 1000.0;
  const std::string svg = line_chart_svg(chart);
  const test::DrawnAxis y = test::y_axis(svg);
  for (const test::Element& marker : elements(svg, "lw-marker")) {
    const double place = numbers(marker.attributes.at("transform"))[1];
    if (place < test::plot_top(svg) - 1.0) continue;  // the legend's
    EXPECT_LE(place, y.place(1000.0) + 1.0);
  }
  EXPECT_EQ(elements(svg, "lw-marker").size(), 3U);  // 1450, 1075 and the legend's
  EXPECT_NE(svg.find("<svg x="), std::string::npos);
}

TEST(LineChart, KeepsLabelsApart) {
  for (const double width : {320.0, 640.0, 1600.0}) {
    for (const double last : {9.0, 4e5, 9.9e5, 3e7, 2e12}) {
      LineChart chart = small_chart();
      chart.frame.width = width;
      chart.series[0].points.push_back({last, 800.0});
      const std::string svg = line_chart_svg(chart);
      const auto ticks = elements(svg, "lw-tick-x");
      ASSERT_GE(ticks.size(), 2U) << width << " " << last;
      double free = 0.0;
      for (const test::Element& tick : ticks) {
        const double half = markup::text_width(tick.text, 14.0) / 2.0;
        EXPECT_GE(tick.number("x") - half, free) << tick.text;
        free = tick.number("x") + half;
      }
      EXPECT_LE(free, width);
    }
  }
}

TEST(LineChart, DrawsLongRunsInAFileThatDoesNotGrow) {
  LineChart chart = small_chart();
  chart.series[0].points.clear();
  for (int i = 0; i < 100'000; ++i) {
    chart.series[0].points.push_back({static_cast<double>(i), i == 77'777 ? 900.0 : i % 7 * 1.0});
  }
  const std::string svg = line_chart_svg(chart);
  EXPECT_LT(svg.size(), 150'000U);
  // The single high value is still there.
  const auto path = numbers(elements(svg, "lw-line").back().attributes.at("d"));
  double top = 1e9;
  for (std::size_t i = 1; i < path.size(); i += 2) top = std::min(top, path[i]);
  EXPECT_NEAR(top, test::y_axis(svg).place(900.0), 0.05);
}

}  // namespace
}  // namespace linewright
