#include "linewright/charts/radar_chart.hpp"

#include <gtest/gtest.h>

#include "svg_reader.hpp"

namespace linewright {
namespace {

using test::elements;
using test::numbers;

RadarChart small_chart() {
  return {.frame = {.title = "Improvement"},
          .axes = {"makespan", "travel", "waiting", "balance"},
          .scale = {.title = "over EBQ-G", .low = 0.0, .high = 2.0},
          .series = {{"EBQ-N", 0, {1.5, 0.5, 1.0, 2.0}}},
          .base = 1.0,
          .base_name = "EBQ-G"};
}

TEST(RadarChart, PutsValuesAtTheirShareOfTheOuterRing) {
  const RadarChart chart = small_chart();
  const std::string svg = radar_chart_svg(chart);
  std::vector<double> outer;  // the largest ring
  for (const test::Element& ring : elements(svg, "lw-grid")) {
    const auto path = numbers(ring.attributes.at("d"));
    if (path.size() == 8 && (outer.empty() || path[1] < outer[1])) outer = path;
  }
  ASSERT_EQ(outer.size(), 8U);
  const double x = (outer[2] + outer[6]) / 2.0;
  const double y = (outer[1] + outer[5]) / 2.0;
  const auto line = numbers(elements(svg, "lw-line").back().attributes.at("d"));
  ASSERT_EQ(line.size(), 8U);
  for (std::size_t i = 0; i < 4; ++i) {
    const double share = chart.series[0].values[i] / 2.0;
    EXPECT_NEAR(line[2 * i], x + share * (outer[2 * i] - x), 0.05);
    EXPECT_NEAR(line[2 * i + 1], y + share * (outer[2 * i + 1] - y), 0.05);
  }
  const auto base = numbers(elements(svg, "lw-ref").back().attributes.at("d"));
  EXPECT_NEAR(base[1], (y + outer[1]) / 2.0, 0.05);
  // Clockwise from the top, with the numbers on the rings.
  EXPECT_LT(outer[1], y);
  EXPECT_GT(outer[2], x);
  EXPECT_EQ(elements(svg, "lw-tick-y").front().text, "0");
}

TEST(RadarChart, OpensTheLineWhereAValueIsMissing) {
  RadarChart chart = small_chart();
  EXPECT_TRUE(elements(radar_chart_svg(chart), "lw-line").back().attributes.at("d").ends_with("Z"));
  chart.series[0].values[1] = kMissing;
  const std::string svg = radar_chart_svg(chart);
  const std::string path = elements(svg, "lw-line").back().attributes.at("d");
  EXPECT_EQ(path.find('Z'), std::string::npos);
  EXPECT_EQ(numbers(path).size(), 8U);  // alone; waiting, balance and back to the first
  EXPECT_EQ(test::count(path, "M"), 2U);
  EXPECT_EQ(elements(svg, "lw-marker").size(), 4U);  // one in the legend
  EXPECT_TRUE(elements(svg, "lw-area").empty());
  EXPECT_EQ(test::chart_fault(svg), "");
}

TEST(RadarChart, KeepsNamesWithinTheChart) {
  RadarChart chart = small_chart();
  chart.axes.assign(12, "a rather long name of a metric that nobody reads");
  chart.frame.width = 320.0;
  const std::string svg = radar_chart_svg(chart);
  EXPECT_EQ(test::chart_fault(svg), "");
  EXPECT_EQ(elements(svg, "lw-axis-name").size(), 12U);
}

TEST(RadarChart, DrawsOneAndTwoAxes) {
  RadarChart chart = small_chart();
  for (const std::size_t axes : {1U, 2U}) {
    chart.axes.resize(axes);
    EXPECT_EQ(test::chart_fault(radar_chart_svg(chart)), "");
  }
}

}  // namespace
}  // namespace linewright
