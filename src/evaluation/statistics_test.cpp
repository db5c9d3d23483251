#include "linewright/evaluation/statistics.hpp"

#include <gtest/gtest.h>

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

TEST(WelchDifference, HasTheDegreesOfFreedomOfBothSamples) {
  // Variances 1 and 16 of three and five values: a standard error of 1.8797 and 4.77 degrees, so
  // t of 4 degrees.
  const Spread first = spread_of({9, 10, 11});
  const Spread second = spread_of({12, 16, 20, 20, 22});
  const MeanDifference difference = welch_difference(first, second);
  EXPECT_NEAR(difference.mean, 8.0, 1e-9);
  EXPECT_NEAR(difference.ci95, 5.2189, 1e-3);
}

TEST(WelchDifference, HasNoIntervalWithoutTwoValuesEach) {
  EXPECT_EQ(welch_difference(spread_of({1, 2}), spread_of({4})).mean, 2.5);
  EXPECT_EQ(welch_difference(spread_of({1, 2}), spread_of({4})).ci95, 0.0);
  EXPECT_EQ(welch_difference(spread_of({1, 1}), spread_of({4, 4})).ci95, 0.0);
}

}  // namespace
}  // namespace linewright
