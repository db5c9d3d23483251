#include "linewright/network/noise.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace linewright {
namespace {

/// e from f(e).
std::vector<double> normal_numbers(std::size_t count) {
  RandomStream random(1);
  std::vector<float> scaled(count);
  sample_scaled_normal(random, scaled);
  std::vector<double> normal;
  for (const float f : scaled) normal.push_back(std::copysign(double{f} * f, f));
  return normal;
}

double share_below(double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); }

TEST(Noise, IsNormallyDistributed) {
  constexpr std::size_t kCount = 1'000'000;
  std::vector<double> normal = normal_numbers(kCount);
  std::sort(normal.begin(), normal.end());
  double largest_gap = 0.0;  // Kolmogorov and Smirnov's
  for (std::size_t i = 0; i < kCount; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(kCount);
    largest_gap = std::max(largest_gap, std::abs(share_below(normal[i]) - share));
  }
  EXPECT_LT(largest_gap, 1.95 / std::sqrt(static_cast<double>(kCount)));  // one in a thousand
  EXPECT_GT(normal.back(), 4.0);
  EXPECT_LT(normal.back(), 5.9);
  EXPECT_LT(normal.front(), -4.0);
}

TEST(Noise, HasTheMomentsOfANormalDistribution) {
  constexpr std::size_t kCount = 1'000'000;
  double sums[4] = {};
  for (const double e : normal_numbers(kCount)) {
    double power = 1.0;
    for (double& sum : sums) sum += (power *= e) / static_cast<double>(kCount);
  }
  EXPECT_NEAR(sums[0], 0.0, 0.004);
  EXPECT_NEAR(sums[1], 1.0, 0.006);
  EXPECT_NEAR(sums[2], 0.0, 0.016);
  EXPECT_NEAR(sums[3], 3.0, 0.04);
}

TEST(Noise, NumbersOfAPairAreUncorrelated) {
  const std::vector<double> normal = normal_numbers(1'000'000);
  double products = 0.0;
  double squares = 0.0;
  for (std::size_t i = 0; i < normal.size(); i += 2) {
    products += normal[i] * normal[i + 1];
    squares += (normal[i] * normal[i] - 1.0) * (normal[i + 1] * normal[i + 1] - 1.0);
  }
  EXPECT_NEAR(products / 500'000, 0.0, 0.006);
  EXPECT_NEAR(squares / 500'000, 0.0, 0.012);
}

TEST(Noise, SameStreamGivesTheSameNumbersAndMovesOn) {
  Noise first;
  first.advantage_hidden = {std::vector<float>(5), std::vector<float>(3)};
  first.value_out = {std::vector<float>(4), std::vector<float>(1)};
  Noise second = first;
  RandomStream a(9);
  RandomStream b(9);
  sample_noise(a, first);
  sample_noise(b, second);
  EXPECT_EQ(first.advantage_hidden.in, second.advantage_hidden.in);
  EXPECT_EQ(first.value_out.out, second.value_out.out);
  sample_noise(b, second);
  EXPECT_NE(first.advantage_hidden.in, second.advantage_hidden.in);
  EXPECT_TRUE(first.advantage_out.in.empty());
}

}  // namespace
}  // namespace linewright
