#include "linewright/routing/reeds_shepp.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "linewright/base/random.hpp"

namespace linewright {
namespace {

constexpr double kPi = std::numbers::pi;

Pose2 random_pose(RandomStream& random, double size_m) {
  return {size_m * (2 * random.uniform() - 1), size_m * (2 * random.uniform() - 1),
          kPi * (2 * random.uniform() - 1)};
}

Pose2 end_of(const Pose2& from, const ReedsSheppCurve& curve, double radius_m) {
  Pose2 at = from;
  for (const PathSegment& piece : curve.segments()) {
    at = advanced(at, piece.kind, piece.amount, radius_m);
  }
  return at;
}

void expect_at(const Pose2& at, const Pose2& to) {
  EXPECT_NEAR(at.x_m, to.x_m, 1e-8);
  EXPECT_NEAR(at.y_m, to.y_m, 1e-8);
  EXPECT_NEAR(std::remainder(at.heading_rad - to.heading_rad, 2 * kPi), 0.0, 1e-8);
}

TEST(ReedsShepp, LeadsExactlyToTheGoalWithEveryWord) {
  RandomStream random(1);
  std::set<int> seen;
  for (int i = 0; i < 20000; ++i) {
    const Pose2 from = random_pose(random, 5.0);
    const Pose2 to = random_pose(random, i % 2 == 0 ? 5.0 : 1.0);
    const double radius_m = 0.3 + 2.0 * random.uniform();
    const ReedsSheppCurve shortest = reeds_shepp(from, to, radius_m);
    seen.insert(shortest.word);
    expect_at(end_of(from, shortest, radius_m), to);
    EXPECT_NEAR(shortest.metres(), reeds_shepp_m(from, to, radius_m), 1e-9);
    EXPECT_GE(shortest.metres(), distance_m(from.point(), to.point()) - 1e-9);
    for (std::uint8_t word = 0; word < kReedsSheppWords; ++word) {
      const ReedsSheppCurve curve = same_reeds_shepp_word(from, to, radius_m, word);
      if (curve.count == 0) continue;
      expect_at(end_of(from, curve, radius_m), to);
      EXPECT_GE(curve.metres(), shortest.metres() - 1e-9);
    }
  }
  EXPECT_GE(seen.size(), 40U);  // nearly every word is the shortest somewhere
}

TEST(ReedsShepp, IsAMetric) {
  RandomStream random(2);
  for (int i = 0; i < 5000; ++i) {
    const Pose2 a = random_pose(random, 3.0);
    const Pose2 b = random_pose(random, 3.0);
    const Pose2 c = random_pose(random, 3.0);
    EXPECT_NEAR(reeds_shepp_m(a, b, 1.0), reeds_shepp_m(b, a, 1.0), 1e-8);
    EXPECT_LE(reeds_shepp_m(a, c, 1.0), reeds_shepp_m(a, b, 1.0) + reeds_shepp_m(b, c, 1.0) + 1e-8);
  }
}

TEST(ReedsShepp, KnowsTheTextbookManoeuvres) {
  EXPECT_NEAR(reeds_shepp_m({0, 0, 0}, {5, 0, 0}, 1.0), 5.0, 1e-12);
  EXPECT_NEAR(reeds_shepp_m({0, 0, 0}, {-5, 0, 0}, 1.0), 5.0, 1e-12);
  EXPECT_NEAR(reeds_shepp_m({0, 0, 0}, {1, 1, kPi / 2}, 1.0), kPi / 2, 1e-9);
  EXPECT_NEAR(reeds_shepp_m({0, 0, 0}, {0, 0, kPi}, 1.0), kPi, 1e-9);  // three arcs of 60 degrees
  EXPECT_EQ(reeds_shepp({1, 2, 3}, {1, 2, 3}, 1.0).metres(), 0.0);
}

TEST(ReedsShepp, TheCheapestCurveHonoursItsCosts) {
  RandomStream random(3);
  const DrivingCosts dear{
      .reverse = 2.0, .direction_change_m = 1.0, .arc = 1.1, .turn_m_per_rad = 0.0};
  for (int i = 0; i < 3000; ++i) {
    const Pose2 from = random_pose(random, 3.0);
    const Pose2 to = random_pose(random, 3.0);
    const ReedsSheppCurve cheapest = cheapest_reeds_shepp(from, to, 0.8, dear);
    expect_at(end_of(from, cheapest, 0.8), to);
    double least = 1e300;
    for (std::uint8_t word = 0; word < kReedsSheppWords; ++word) {
      const ReedsSheppCurve curve = same_reeds_shepp_word(from, to, 0.8, word);
      if (curve.count > 0) least = std::min(least, driving_cost_m(curve.segments(), dear));
    }
    EXPECT_NEAR(driving_cost_m(cheapest.segments(), dear), least, 1e-9);
    EXPECT_GE(cheapest.metres(), reeds_shepp_m(from, to, 0.8) - 1e-9);
  }
}

}  // namespace
}  // namespace linewright
