#include "linewright/routing/path.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace linewright {
namespace {

using Kind = PathSegment::Kind;
constexpr double kPi = std::numbers::pi;

Path example() {
  Path path;
  path.status = PathStatus::kFound;
  path.start = {1.0, 2.0, 0.0};
  path.turning_radius_m = 2.0;
  path.segments = {{Kind::kStraight, 3.0},
                   {Kind::kLeft, kPi},  // a quarter of a circle
                   {Kind::kTurn, -kPi / 2},
                   {Kind::kStraight, -1.0}};
  return path;
}

TEST(Path, AddsUpItsPieces) {
  const Path path = example();
  EXPECT_DOUBLE_EQ(path.metres(), 4.0 + kPi);
  EXPECT_DOUBLE_EQ(path.turned_rad(), kPi / 2);
  EXPECT_EQ(path.direction_changes(), 1);
  EXPECT_NEAR(path.end().x_m, 5.0, 1e-12);
  EXPECT_NEAR(path.end().y_m, 4.0, 1e-12);
  EXPECT_NEAR(path.end().heading_rad, 0.0, 1e-12);
}

TEST(Path, SamplesNoFartherApartThanAskedFor) {
  const std::vector<Pose2> poses = sampled(example(), 0.05, 0.1);
  for (std::size_t i = 1; i < poses.size(); ++i) {
    EXPECT_LE(distance_m(poses[i - 1].point(), poses[i].point()), 0.05 + 1e-12);
    EXPECT_LE(std::abs(poses[i].heading_rad - poses[i - 1].heading_rad), 0.1 + 1e-12);
  }
}

TEST(TravelTime, FollowsFromLengthSpeedAndTurning) {
  const double metres = 4.0 + kPi;
  EXPECT_DOUBLE_EQ(travel_seconds(example(), {.speed_mps = 2.0}), metres / 2.0);
  EXPECT_DOUBLE_EQ(travel_seconds(example(), {.speed_mps = 2.0, .turn_rate_radps = kPi / 4}),
                   metres / 2.0 + 2.0);
}

TEST(TravelTime, WithAccelerationStartsAndStopsAtEveryStand) {
  Path path;
  path.status = PathStatus::kFound;
  path.segments = {{Kind::kStraight, 10.0}};
  // 2 s up to 2 m/s over 2 m, the same down, 6 m at full speed.
  EXPECT_NEAR(travel_seconds(path, {.speed_mps = 2.0, .acceleration_mps2 = 1.0}), 7.0, 1e-12);
  // Too short for the full speed: up for 0.5 m, down for 0.5 m.
  path.segments = {{Kind::kStraight, 1.0}};
  EXPECT_NEAR(travel_seconds(path, {.speed_mps = 2.0, .acceleration_mps2 = 1.0}), 2.0, 1e-12);
  // To and fro is twice that.
  path.segments = {{Kind::kStraight, 1.0}, {Kind::kStraight, -1.0}};
  EXPECT_NEAR(travel_seconds(path, {.speed_mps = 2.0, .acceleration_mps2 = 1.0}), 4.0, 1e-12);
}

TEST(WayPoints, AgreeWithTheTravelTimeAtEveryPoint) {
  for (const double acceleration : {0.0, 0.7}) {
    const Motion motion{
        .speed_mps = 1.5, .turn_rate_radps = 1.0, .acceleration_mps2 = acceleration};
    const Path path = example();
    const std::vector<WayPoint> points = way_points(path, motion);
    const double total = travel_seconds(path, motion);
    EXPECT_EQ(points.front().share, 0.0);
    EXPECT_EQ(points.back().share, 1.0);
    EXPECT_NEAR(points.back().pose.x_m, path.end().x_m, 1e-9);
    for (std::size_t i = 1; i < points.size(); ++i) {
      EXPECT_GE(points[i].share, points[i - 1].share);
      const double metres = distance_m(points[i - 1].pose.point(), points[i].pose.point());
      const double seconds = (points[i].share - points[i - 1].share) * total;
      EXPECT_LE(metres, 1.5 * seconds + 1e-9);  // never faster than its speed
    }
  }
}

}  // namespace
}  // namespace linewright
