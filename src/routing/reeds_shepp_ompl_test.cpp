// Lengths of Reeds-Shepp curves against those of OMPL (https://ompl.kavrakilab.org): a file of 200,
// and, where OMPL is installed, 100,000 more.

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "linewright/base/random.hpp"
#include "linewright/routing/reeds_shepp.hpp"

#ifdef LINEWRIGHT_HAS_OMPL
#include <ompl/base/spaces/ReedsSheppStateSpace.h>
#endif

namespace linewright {
namespace {

TEST(ReedsShepp, HasTheLengthsOfTheFixture) {
  std::ifstream file(LINEWRIGHT_SOURCE_DIR "/tests/data/reeds_shepp_lengths.txt");
  ASSERT_TRUE(file);
  std::string heading;
  std::getline(file, heading);
  int count = 0;
  double radius_m = 0.0;
  Pose2 a;
  Pose2 b;
  double metres = 0.0;
  while (file >> radius_m >> a.x_m >> a.y_m >> a.heading_rad >> b.x_m >> b.y_m >> b.heading_rad >>
         metres) {
    EXPECT_NEAR(reeds_shepp_m(a, b, radius_m), metres, 1e-9 * metres) << "line " << count + 2;
    ++count;
  }
  EXPECT_EQ(count, 200);
}

#ifdef LINEWRIGHT_HAS_OMPL

TEST(ReedsShepp, HasTheLengthsOfOmpl) {
  using Space = ompl::base::ReedsSheppStateSpace;
  RandomStream random(91);
  const auto set = [&](Space::StateType* state, double size_m) {
    const Pose2 pose{size_m * (2 * random.uniform() - 1), size_m * (2 * random.uniform() - 1),
                     std::numbers::pi * (2 * random.uniform() - 1)};
    state->setXY(pose.x_m, pose.y_m);
    state->setYaw(pose.heading_rad);
    return pose;
  };
  for (const double radius_m : {0.3, 1.0, 2.5}) {
    const Space space(radius_m);
    auto* from = space.allocState()->as<Space::StateType>();
    auto* to = space.allocState()->as<Space::StateType>();
    for (int i = 0; i < 34'000; ++i) {
      const double size_m = i % 2 == 0 ? 10.0 : 1.5 * radius_m;
      const Pose2 a = set(from, size_m);
      const Pose2 b = set(to, size_m);
      const double metres = space.distance(from, to);
      ASSERT_NEAR(reeds_shepp_m(a, b, radius_m), metres, 1e-9 * metres);
    }
    space.freeState(from);
    space.freeState(to);
  }
}

#endif

}  // namespace
}  // namespace linewright
