#include "ppo_trainer.hpp"

#include <gtest/gtest.h>

namespace linewright::learning {
namespace {

TEST(Advantages, AreAsByHandAndInOrderOfTheEpisode) {
  // gamma 0.5, lambda 0.5. Last: 2 - 1 = 1. Middle: 0 + 0.5 * 1 - 3 = -2.5, plus 0.25 * 1.
  const std::vector<float> advantages =
      advantages_of({1.0F, 0.0F, 2.0F}, {0.5F, 3.0F, 1.0F}, 0.5, 0.5);
  ASSERT_EQ(advantages.size(), 3U);
  EXPECT_FLOAT_EQ(advantages[2], 1.0F);
  EXPECT_FLOAT_EQ(advantages[1], -2.25F);
  EXPECT_FLOAT_EQ(advantages[0], 1.0F + 0.5F * 3.0F - 0.5F + 0.25F * -2.25F);
}

TEST(Advantages, WithLambdaOneAreTheReturnsLessTheValues) {
  const std::vector<float> advantages = advantages_of({1.0F, 2.0F}, {0.25F, 0.5F}, 0.9, 1.0);
  EXPECT_FLOAT_EQ(advantages[0], 1.0F + 0.9F * 2.0F - 0.25F);
  EXPECT_FLOAT_EQ(advantages[1], 1.5F);
}

}  // namespace
}  // namespace linewright::learning
