#include "linewright/charts/bar_chart.hpp"

#include <gtest/gtest.h>

#include "linewright/base/markup.hpp"
#include "svg_reader.hpp"

namespace linewright {
namespace {

using test::elements;
using test::numbers;

BarChart small_chart() {
  return {
      .frame = {.title = "Makespan by crew"},
      .category_title = "crew",
      .categories = {"H1R1", "H2R2"},
      .y = {.title = "ticks"},
      .series = {{"EBQ-N", 0, {{1200.0, 1150.0, 1260.0, 1300.0}, {800.0}}}, {"PPO", 4, {{1400.0}}}},
      .reference_name = "paper"};
}

/// The bars of the plot; the legend's come first.
std::vector<test::Element> bars_of(const BarChart& chart, const std::string& svg) {
  std::vector<test::Element> bars = elements(svg, "lw-bar");
  bars.erase(bars.begin(), bars.begin() + static_cast<std::ptrdiff_t>(chart.series.size()));
  return bars;
}

TEST(BarChart, DrawsBarsAsHighAsTheAxisSays) {
  const BarChart chart = small_chart();
  const std::string svg = bar_chart_svg(chart);
  const test::DrawnAxis y = test::y_axis(svg);
  const auto bars = bars_of(chart, svg);
  ASSERT_EQ(bars.size(), 3U);  // the missing one is absent
  const double values[] = {1200.0, 800.0, 1400.0};
  for (std::size_t i = 0; i < bars.size(); ++i) {
    EXPECT_NEAR(bars[i].number("y"), y.place(values[i]), 0.05);
    EXPECT_NEAR(bars[i].number("y") + bars[i].number("height"), y.place(0.0), 0.05);
  }
  const auto ticks = elements(svg, "lw-tick-x");
  ASSERT_EQ(ticks.size(), 2U);
  // The first bar of a pair ends where the second begins: at the middle of their category.
  EXPECT_NEAR(bars[0].number("x") + bars[0].number("width"), ticks[0].number("x"), 1.1);
  EXPECT_NEAR(bars[2].number("x"), ticks[0].number("x"), 1.1);
}

TEST(BarChart, PutsWhiskersAndDiamondsAtTheirValues) {
  const std::string svg = bar_chart_svg(small_chart());
  const test::DrawnAxis y = test::y_axis(svg);
  const auto whiskers = elements(svg, "lw-whisker");
  ASSERT_EQ(whiskers.size(), 1U);
  const auto path = numbers(whiskers[0].attributes.at("d"));
  EXPECT_NEAR(path[1], y.place(1150.0), 0.05);
  EXPECT_NEAR(path[3], y.place(1260.0), 0.05);
  const auto diamonds = elements(svg, "lw-diamond");
  ASSERT_EQ(diamonds.size(), 2U);  // one in the legend
  EXPECT_NEAR(numbers(diamonds[1].attributes.at("transform"))[1], y.place(1300.0), 0.05);
  EXPECT_EQ(test::count(svg, ">paper<"), 1U);
}

TEST(BarChart, SaysWhenBarsDoNotBeginAtZero) {
  BarChart chart = small_chart();
  EXPECT_EQ(test::count(bar_chart_svg(chart), "axis not from 0"), 0U);
  chart.from_zero = false;
  EXPECT_EQ(test::count(bar_chart_svg(chart), ">ticks, axis not from 0<"), 1U);
  chart.y.title.clear();
  EXPECT_EQ(test::count(bar_chart_svg(chart), ">axis not from 0<"), 1U);
  chart.from_zero = true;
  chart.y.low = 500.0;
  const std::string svg = bar_chart_svg(chart);
  EXPECT_EQ(test::count(svg, ">axis not from 0<"), 1U);
  EXPECT_NEAR(bars_of(chart, svg)[0].number("y"), test::y_axis(svg).place(1200.0), 0.05);
}

TEST(BarChart, LetsNegativeBarsHangFromZero) {
  BarChart chart = small_chart();
  chart.series[0].bars[1].value = -300.0;
  const std::string svg = bar_chart_svg(chart);
  const test::DrawnAxis y = test::y_axis(svg);
  const auto bars = bars_of(chart, svg);
  EXPECT_NEAR(bars[1].number("y"), y.place(0.0), 0.05);
  EXPECT_NEAR(bars[1].number("height"), y.place(-300.0) - y.place(0.0), 0.05);
}

TEST(BarChart, KeepsCategoriesApart) {
  for (const std::size_t count : {1U, 9U, 30U, 200U}) {
    BarChart chart = small_chart();
    chart.categories.assign(count, "most_urgent_buffer of all");
    chart.series[0].bars.assign(count, {1.0});
    const std::string svg = bar_chart_svg(chart);
    EXPECT_EQ(test::chart_fault(svg), "");
    const auto ticks = elements(svg, "lw-tick-x");
    double last = -100.0;
    for (const test::Element& tick : ticks) {
      // Level lines of one name share their x; slanted names stand at the origin of a group.
      if (tick.number("x") == last || tick.number("x") == 0.0) continue;
      EXPECT_GT(tick.number("x") - last, markup::text_width(tick.text, 14.0));
      last = tick.number("x");
    }
    EXPECT_LT(ticks.size(), 40U);
  }
}

TEST(BarChart, TakesMoreOrFewerBarsThanCategories) {
  BarChart chart = small_chart();
  chart.series[1].bars.assign(5, {700.0});
  EXPECT_EQ(bars_of(chart, bar_chart_svg(chart)).size(), 4U);
  chart.categories.clear();
  EXPECT_EQ(test::count(bar_chart_svg(chart), "no data"), 1U);
}

}  // namespace
}  // namespace linewright
