// What holds for charts of all kinds.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <locale>
#include <random>

#include "linewright/charts/bar_chart.hpp"
#include "linewright/charts/line_chart.hpp"
#include "linewright/charts/radar_chart.hpp"
#include "svg_reader.hpp"

namespace linewright {
namespace {

const std::string kHostile = "</title><script>alert(\"1\")</script> & 'H3R3' ü 部品 \x01\xff";

/// Words and numbers of a chart, some of them unfit to be drawn.
class Source {
 public:
  explicit Source(std::uint64_t seed) : random_(seed) {}

  std::size_t up_to(std::size_t most) { return random_() % (most + 1); }

  double value() {
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    constexpr double kOdd[] = {kMissing, kInfinite, -kInfinite, 1e300, -1e15, 5e-324, -0.0, 0.0};
    if (up_to(3) == 0) return kOdd[up_to(7)];
    return (static_cast<double>(up_to(2000)) - 700.0) * scale_;
  }

  std::string words() {
    const std::string kWords[] = {"", "EBQ-N", kHostile, std::string(300, 'w'), "two words"};
    return kWords[up_to(4)];
  }

  ChartFrame frame() {
    return {.title = words(),
            .description = words(),
            .width = up_to(4) == 0 ? value() : 640.0,
            .height = up_to(4) == 0 ? value() : 400.0,
            .with_style = up_to(1) == 0};
  }

  ChartAxis axis() {
    ChartAxis axis{.title = words(), .unit = words(), .integer = up_to(2) == 0};
    if (up_to(2) == 0) axis.low = value();
    if (up_to(2) == 0) axis.high = value();
    return axis;
  }

  std::vector<ReferenceLine> references() {
    std::vector<ReferenceLine> lines(up_to(3));
    for (ReferenceLine& line : lines) line = {value(), words(), up_to(20)};
    return lines;
  }

 private:
  std::mt19937_64 random_;
  double scale_ = std::pow(10.0, static_cast<double>(up_to(16)) - 8.0);
};

std::string some_line_chart(std::uint64_t seed) {
  Source some(seed);
  LineChart chart{.frame = some.frame(), .x = some.axis(), .y = some.axis()};
  chart.series.resize(some.up_to(5));
  for (LineSeries& series : chart.series) {
    series = {some.words(), some.up_to(40), {}, some.up_to(1) == 0};
    series.points.resize(some.up_to(12));
    for (LinePoint& p : series.points) p = {some.value(), some.value(), some.value(), some.value()};
  }
  chart.references = some.references();
  return line_chart_svg(chart);
}

std::string some_bar_chart(std::uint64_t seed) {
  Source some(seed);
  BarChart chart{.frame = some.frame(), .category_title = some.words(), .y = some.axis()};
  chart.categories.resize(some.up_to(9));
  for (std::string& category : chart.categories) category = some.words();
  chart.from_zero = some.up_to(1) == 0;
  chart.reference_name = some.words();
  chart.series.resize(some.up_to(12));
  for (BarSeries& series : chart.series) {
    series = {some.words(), some.up_to(40), {}};
    series.bars.resize(some.up_to(10));
    for (ChartBar& bar : series.bars)
      bar = {some.value(), some.value(), some.value(), some.value()};
  }
  chart.references = some.references();
  return bar_chart_svg(chart);
}

std::string some_radar_chart(std::uint64_t seed) {
  Source some(seed);
  RadarChart chart{.frame = some.frame(), .scale = some.axis(), .base_name = some.words()};
  chart.axes.resize(some.up_to(12));
  for (std::string& axis : chart.axes) axis = some.words();
  chart.series.resize(some.up_to(8));
  for (RadarSeries& series : chart.series) {
    series = {some.words(), some.up_to(40), {}};
    series.values.resize(some.up_to(13));
    for (double& value : series.values) value = some.value();
  }
  if (some.up_to(1) == 0) chart.base = some.value();
  return radar_chart_svg(chart);
}

const std::function<std::string(std::uint64_t)> kKinds[] = {some_line_chart, some_bar_chart,
                                                            some_radar_chart};

TEST(Charts, AreSoundWhateverTheyAreGiven) {
  for (const auto& kind : kKinds) {
    for (std::uint64_t seed = 0; seed < 80; ++seed) {
      const std::string svg = kind(seed);
      ASSERT_EQ(test::chart_fault(svg), "") << seed << "\n" << svg;
      ASSERT_EQ(svg.find("<script"), std::string::npos) << seed;
    }
  }
}

TEST(Charts, PutTheLegendAboveThePlot) {
  for (const auto& kind : kKinds) {
    for (std::uint64_t seed = 0; seed < 80; ++seed) {
      const std::string svg = kind(seed);
      EXPECT_LE(test::legend_bottom(svg), test::plot_top(svg)) << seed << "\n" << svg;
    }
  }
}

/// Numbers as in 1.234,5.
class OtherNumbers : public std::numpunct<char> {
 protected:
  [[nodiscard]] char do_decimal_point() const override { return ','; }
  [[nodiscard]] char do_thousands_sep() const override { return '.'; }
  [[nodiscard]] std::string do_grouping() const override { return "\3"; }
};

TEST(Charts, HaveTheSameBytesEveryTimeAndInEveryLocale) {
  for (const auto& kind : kKinds) {
    const std::string svg = kind(7);
    const std::locale before =
        std::locale::global(std::locale(std::locale::classic(), new OtherNumbers));
    const std::string again = kind(7);
    std::locale::global(before);
    EXPECT_EQ(svg, again);
  }
}

TEST(Charts, SayWhenThereIsNoData) {
  for (const std::string& svg :
       {line_chart_svg({}), bar_chart_svg({}), radar_chart_svg({}),
        line_chart_svg({.series = {{"a", 0, {{kMissing, 1.0}, {1.0, kMissing}}}},
        .references = {{1.0, "reference", {}}}}),
        bar_chart_svg({.categories = {"a"}, .series = {{"b", 0, {{}}}}}),
        radar_chart_svg({.axes = {"a", "b"}, .series = {{"c", 0, {kMissing}}}, .base = 1.0})}) {
    EXPECT_EQ(test::count(svg, ">no data<"), 1U);
    EXPECT_EQ(test::chart_fault(svg), "");
  }
}

TEST(Charts, LeaveTheStyleToThePageWhenAsked) {
  const LineChart chart{.frame = {.title = "t", .with_style = false}};
  EXPECT_EQ(line_chart_svg(chart).find("<style"), std::string::npos);
  EXPECT_NE(line_chart_svg({}).find(charts_style_sheet()), std::string::npos);
  EXPECT_NE(charts_style_sheet().find("prefers-color-scheme:dark"), std::string::npos);
}

TEST(Charts, AreAsHighAsTheyNeed) {
  LineChart chart{.frame = {.height = 200.0}};
  for (int i = 0; i < 30; ++i) {
    chart.series.push_back({"a series with a name of some length", 0, {{0.0, 1.0}, {1.0, 2.0}}});
  }
  const std::string svg = line_chart_svg(chart);
  const double height = test::elements(svg, "lw-chart").at(0).number("height");
  EXPECT_GT(height, test::plot_top(svg) + 150.0);
  EXPECT_LE(test::legend_bottom(svg), test::plot_top(svg));
}

TEST(Charts, GiveEveryStyleItsOwnLook) {
  const std::string css = charts_style_sheet();
  std::vector<std::string> markers;
  std::vector<std::string> dashes;
  LineChart chart;
  for (std::size_t style = 0; style < kChartStyles; ++style) {
    chart.series = {{"", style, {{0.0, 0.0}}, true}};
    markers.push_back(test::elements(line_chart_svg(chart), "lw-marker").at(0).attributes.at("d"));
    const std::size_t begin = css.find(".lw-d" + std::to_string(style) + "{") + 8;
    dashes.push_back(css.substr(begin, css.find('}', begin) - begin));
  }
  for (std::size_t a = 0; a < kChartStyles; ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      EXPECT_NE(markers[a], markers[b]);
      EXPECT_NE(dashes[a], dashes[b]);
    }
  }
}

}  // namespace
}  // namespace linewright
