#include "linewright/line/line_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace linewright {
namespace {

TEST(Amount, GrowsWithTheOrder) {
  EXPECT_EQ((Amount{3, 2}).value(5), 13);
  EXPECT_EQ((Amount{0, 1'000'000}).value(1'000'000), 1'000'000'000'000);
}

TEST(Horizon, IsThatOfTheSmallestEntryTheOrderFitsIn) {
  const Horizon horizon{{{5, 2000}, {8, 2500}, {10, 3000}}};
  EXPECT_EQ(horizon.ticks(1), 2000);
  EXPECT_EQ(horizon.ticks(5), 2000);
  EXPECT_EQ(horizon.ticks(6), 2500);
  EXPECT_EQ(horizon.ticks(10), 3000);
  EXPECT_EQ(horizon.ticks(99), 3000);
}

TEST(TravelTable, KnowsTheWayToItselfAndNoOther) {
  TravelTable table(2);
  EXPECT_EQ(table.leg(StationId(1), StationId(1)).ticks, 0);
  EXPECT_EQ(table.leg(StationId(0), StationId(1)).ticks, -1);
  EXPECT_TRUE(table.path(StationId(0), StationId(1)).empty());
  table.set(StationId(0), StationId(1), {7, 9.5});
  table.set_path(StationId(0), StationId(1), {{{0, 0, 0}, 0.0}, {{1, 1, 0}, 1.0}});
  EXPECT_EQ(table.leg(StationId(0), StationId(1)).ticks, 7);
  EXPECT_EQ(table.path(StationId(0), StationId(1)).size(), 2U);
  EXPECT_TRUE(table.path(StationId(1), StationId(0)).empty());
}

TEST(PoseOn, GoesAlongThePathAndTurnsTheShortWay) {
  constexpr double kPi = std::numbers::pi;
  const std::vector<WayPoint> path{
      {{0, 0, 0}, 0.0}, {{4, 0, 0}, 0.5}, {{4, 0, -0.75 * kPi}, 0.6}, {{4, 0, 0.75 * kPi}, 1.0}};
  EXPECT_DOUBLE_EQ(pose_on(path, -1.0).x_m, 0.0);
  EXPECT_DOUBLE_EQ(pose_on(path, 0.25).x_m, 2.0);
  EXPECT_NEAR(pose_on(path, 0.55).heading_rad, -0.375 * kPi, 1e-12);
  EXPECT_NEAR(std::cos(pose_on(path, 0.8).heading_rad), -1.0, 1e-12);
  EXPECT_DOUBLE_EQ(pose_on(path, 2.0).heading_rad, 0.75 * kPi);
}

}  // namespace
}  // namespace linewright
