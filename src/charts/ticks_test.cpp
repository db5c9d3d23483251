#include "ticks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

namespace linewright::charts {
namespace {

using Labels = std::vector<std::string>;

Range range_of(std::initializer_list<double> values) {
  Range range;
  for (const double value : values) range.add(value);
  return range;
}

Labels labels_of(std::initializer_list<double> values, std::size_t most,
                 const ChartAxis& axis = {}) {
  return tick_labels(make_ticks(range_of(values), axis, AxisEnd::kTick, most), axis.unit);
}

TEST(Ticks, AreNiceFewAndCoverTheData) {
  for (const double low : {0.0, -7.3, 0.00012, 745.0, -1e6, 3e11}) {
    for (const double span : {1e-5, 0.7, 1.0, 33.0, 951.0, 2.5e7}) {
      if (span < std::abs(low) * 1e-8) continue;
      for (const std::size_t most : {2U, 5U, 9U}) {
        const Ticks ticks = make_ticks(range_of({low, low + span}), {}, AxisEnd::kTick, most);
        ASSERT_GE(ticks.values.size(), 2U) << low << " " << span;
        EXPECT_LE(ticks.values.size(), most + 2) << low << " " << span;
        EXPECT_LE(ticks.low, low + span * 1e-5);
        EXPECT_GE(ticks.high, low + span * (1 - 1e-5));
        EXPECT_TRUE((std::set<std::int64_t>{1, 2, 5}.contains(ticks.mantissa)));
        const Labels labels = tick_labels(ticks, "");
        EXPECT_EQ((std::set<std::string>(labels.begin(), labels.end()).size()), labels.size())
            << labels.front();
      }
    }
  }
}

TEST(Ticks, StayWithinTightAxes) {
  const Ticks ticks = make_ticks(range_of({0.3, 4.9}), {}, AxisEnd::kTight, 6);
  EXPECT_EQ(ticks.values, (std::vector<double>{1, 2, 3, 4}));
  EXPECT_EQ(ticks.low, 0.3);
  EXPECT_EQ(ticks.high, 4.9);
}

TEST(Ticks, KeepFixedEnds) {
  const Ticks ticks = make_ticks(range_of({3, 97}), {.low = 0.0, .high = 90.0}, AxisEnd::kTick, 5);
  EXPECT_EQ(ticks.low, 0.0);
  EXPECT_EQ(ticks.high, 90.0);
  const ChartAxis useless{.low = 5.0, .high = 5.0};
  EXPECT_EQ(make_ticks(range_of({3, 97}), useless, AxisEnd::kTick, 5).high, 100.0);
  const ChartAxis not_numbers{.low = kMissing, .high = std::numeric_limits<double>::infinity()};
  EXPECT_EQ(make_ticks(range_of({3, 97}), not_numbers, AxisEnd::kTick, 5).high, 100.0);
}

TEST(Ticks, OfCountsAreWhole) {
  const Ticks ticks = make_ticks(range_of({1, 3}), {.integer = true}, AxisEnd::kTight, 12);
  EXPECT_EQ(ticks.values, (std::vector<double>{1, 2, 3}));
}

TEST(Ticks, CopeWithOneValueAndWithNone) {
  for (const double value : {0.0, 797.0, -1e-300, 1e15, -1e15}) {
    const Ticks ticks = make_ticks(range_of({value}), {}, AxisEnd::kTick, 5);
    EXPECT_LT(ticks.low, ticks.high);
    EXPECT_TRUE(std::isfinite(ticks.share(value)));
  }
  EXPECT_LT(make_ticks(Range(), {}, AxisEnd::kTick, 5).low, 1.0);
}

TEST(Range, LeavesOutWhatCannotBeDrawn) {
  const double infinite = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(range_of({kMissing, infinite, -infinite, 1e16, -1e300}).empty());
  EXPECT_EQ(range_of({kMissing, 4.0, infinite}).high(), 4.0);
}

TEST(TickLabels, AreReadable) {
  EXPECT_EQ(labels_of({-1500, 500}, 4), (Labels{"−1,500", "−1,000", "−500", "0", "500"}));
  EXPECT_EQ(labels_of({0.95, 1.1}, 4), (Labels{"0.95", "1.00", "1.05", "1.10"}));
  EXPECT_EQ(labels_of({-5, 10}, 3, {.unit = " %"}), (Labels{"−5 %", "0 %", "5 %", "10 %"}));
  EXPECT_EQ(labels_of({0, 1.5e6}, 3), (Labels{"0", "0.5 M", "1.0 M", "1.5 M"}));
  EXPECT_EQ(labels_of({0, 4e9}, 2), (Labels{"0", "2×10⁹", "4×10⁹"}));
  EXPECT_EQ(labels_of({0, 2e-5}, 2), (Labels{"0", "1×10⁻⁵", "2×10⁻⁵"}));
}

}  // namespace
}  // namespace linewright::charts
