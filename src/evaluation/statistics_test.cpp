#include "linewright/evaluation/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace linewright {
namespace {

TEST(StudentT, AgreesWithTheTables) {
  EXPECT_NEAR(student_t_975(1), 12.706, 1e-3);
  EXPECT_NEAR(student_t_975(10), 2.228, 1e-3);
  EXPECT_NEAR(student_t_975(11), 2.201, 1e-3);
  EXPECT_NEAR(student_t_975(30), 2.042, 1e-3);
  EXPECT_NEAR(student_t_975(99), 1.984, 1e-3);
  EXPECT_NEAR(student_t_975(100'000), 1.960, 1e-3);
}

TEST(Spread, IsTheSampleMeanDeviationAndInterval) {
  const Spread spread = spread_of({2, 4, 4, 4, 5, 5, 7, 9});
  EXPECT_DOUBLE_EQ(spread.mean, 5.0);
  EXPECT_NEAR(spread.sd, 2.13809, 1e-5);
  EXPECT_NEAR(spread.ci95, 2.3646 * 2.13809 / 2.828427, 1e-4);
}

TEST(Spread, OfOneOrNoValueHasNoWidth) {
  EXPECT_EQ(spread_of({}).count, 0U);
  EXPECT_EQ(spread_of({3}).mean, 3.0);
  EXPECT_EQ(spread_of({3}).ci95, 0.0);
}

TEST(WelchDifference, AgreesWithTheTextbook) {
  // The example of Welch (1947) as in many textbooks: 15 values each.
  const Spread first = spread_of(
      {27.5, 21.0, 19.0, 23.6, 17.0, 17.9, 16.9, 20.1, 21.9, 22.6, 23.1, 19.6, 19.0, 21.7, 21.4});
  const Spread second = spread_of(
      {27.1, 22.0, 20.8, 23.4, 23.4, 23.5, 25.8, 22.0, 24.8, 20.2, 21.9, 22.1, 22.9, 30.5, 24.4});
  const MeanDifference difference = welch_difference(first, second);
  EXPECT_NEAR(difference.mean, 23.653333 - 20.82, 1e-4);
  // Standard error sqrt(7.5046 / 15 + 6.2955 / 15) times t of 27 degrees.
  EXPECT_NEAR(difference.ci95,
              2.0518 * std::sqrt((first.sd * first.sd + second.sd * second.sd) / 15), 2e-3);
}

TEST(WelchDifference, HasNoIntervalWithoutTwoValuesEach) {
  EXPECT_EQ(welch_difference(spread_of({1, 2}), spread_of({4})).mean, 2.5);
  EXPECT_EQ(welch_difference(spread_of({1, 2}), spread_of({4})).ci95, 0.0);
  EXPECT_EQ(welch_difference(spread_of({1, 1}), spread_of({4, 4})).ci95, 0.0);
}

}  // namespace
}  // namespace linewright
