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

}  // namespace
}  // namespace linewright
