#include "linewright/training/replay_buffer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <vector>

#include "numbered_episode.hpp"

namespace linewright {
namespace {

using Errors = std::vector<float>;
using Indices = std::vector<std::uint64_t>;

/// How often each transition was drawn, by index.
std::map<std::uint64_t, double> draws(PrioritizedReplayBuffer& buffer, std::size_t count,
                                      std::size_t batches, double beta = 0.5) {
  RandomStream random(7);
  ReplayBatch batch;
  std::map<std::uint64_t, double> seen;
  for (std::size_t i = 0; i < batches; ++i) {
    buffer.sample(count, beta, random, batch);
    for (const std::uint64_t index : batch.index) seen[index] += 1.0;
  }
  return seen;
}

/// Pearson's statistic of the draws against `weights` by index.
double chi_square(const std::map<std::uint64_t, double>& seen, const std::vector<double>& weights) {
  double draws_made = 0.0;
  double total = 0.0;
  for (const auto& [index, count] : seen) draws_made += count;
  for (const double weight : weights) total += weight;
  double statistic = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const double expected = draws_made * weights[i] / total;
    const double count = seen.contains(i) ? seen.at(i) : 0.0;
    statistic += (count - expected) * (count - expected) / expected;
  }
  return statistic;
}

TEST(ReplayBuffer, DrawsInProportionToThePowerOfTheError) {
  PrioritizedReplayBuffer buffer(kNumberedSize, {.capacity = 100, .alpha = 0.7});
  buffer.insert(numbered_episode(10, 0), 1);
  const Indices index{0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
  const Errors errors{0.1F, -0.2F, 0.3F, 0.4F, -5.0F, 0.6F, 0.7F, 0.01F, 0.9F, 1.0F};
  buffer.update_priorities(index, errors);
  std::vector<double> weights;
  for (const float error : errors) {
    weights.push_back(std::pow(std::abs(static_cast<double>(error)) + 1e-6, 0.7));
  }
  // Single draws are independent: 9 degrees of freedom, 27.9 is the 99.9 % point.
  EXPECT_LT(chi_square(draws(buffer, 1, 100'000), weights), 27.9);
  // Stratified ones are closer than independent ones.
  EXPECT_LT(chi_square(draws(buffer, 64, 2000), weights), 9.0);
}

TEST(ReplayBuffer, AMultiplicityIsWorthAsMuchAsStoringCopies) {
  const ReplayOptions options{.capacity = 1000, .alpha = 0.5};
  PrioritizedReplayBuffer folded(kNumberedSize, options);
  folded.insert(numbered_episode(4, 0), 5);
  folded.insert(numbered_episode(4, 1), 1);
  PrioritizedReplayBuffer unfolded(kNumberedSize, options);
  for (int copy = 0; copy < 5; ++copy) unfolded.insert(numbered_episode(4, 0), 1);
  unfolded.insert(numbered_episode(4, 1), 1);
  EXPECT_EQ(folded.size(), 24U);
  EXPECT_EQ(unfolded.size(), 24U);
  EXPECT_EQ(folded.transitions(), 8U);
  // The same errors for the same transition.
  Indices index;
  Errors errors;
  for (std::uint64_t i = 0; i < 24; ++i) {
    index.push_back(i);
    errors.push_back(0.1F + static_cast<float>(i % 4) + (i < 20 ? 0.0F : 2.0F));
  }
  unfolded.update_priorities(index, errors);
  folded.update_priorities(Indices{0, 1, 2, 3, 4, 5, 6, 7},
                           Errors{0.1F, 1.1F, 2.1F, 3.1F, 2.1F, 3.1F, 4.1F, 5.1F});
  std::map<std::uint64_t, double> summed;
  for (const auto& [i, count] : draws(unfolded, 64, 4000)) {
    summed[i < 20 ? i % 4 : i - 16] += count;
  }
  for (const auto& [i, count] : draws(folded, 64, 4000)) {
    EXPECT_NEAR(count, summed[i], 5.0 * std::sqrt(count)) << i;
  }
  // And the same importance: that of one copy, with N counting copies.
  RandomStream random(1);
  ReplayBatch batch;
  std::map<float, float> of_folded;  // by third feature, which names the transition
  folded.sample(500, 0.6, random, batch);
  for (std::size_t i = 0; i < batch.size; ++i) {
    of_folded[batch.features[i * 3 + 2]] = batch.weight[i];
  }
  unfolded.sample(500, 0.6, random, batch);
  for (std::size_t i = 0; i < batch.size; ++i) {
    EXPECT_NEAR(of_folded.at(batch.features[i * 3 + 2]), batch.weight[i], 1e-5);
  }
}

TEST(ReplayBuffer, WeightsAreThoseOfThePaperByHand) {
  PrioritizedReplayBuffer buffer(kNumberedSize, {.capacity = 10, .alpha = 1.0, .epsilon = 1e-12});
  buffer.insert(numbered_episode(3, 0), 1);
  buffer.update_priorities(Indices{0, 1, 2}, Errors{1.0F, 2.0F, 5.0F});
  RandomStream random(1);
  ReplayBatch batch;
  buffer.sample(64, 0.5, random, batch);
  // N P = 3/8, 6/8, 15/8; to the power -1/2 and over the largest: 1, (1/2)^(1/2), (1/5)^(1/2).
  const std::vector<double> expected{1.0, std::sqrt(0.5), std::sqrt(0.2)};
  for (std::size_t i = 0; i < batch.size; ++i) {
    EXPECT_NEAR(batch.weight[i], expected[batch.index[i]], 1e-6);
  }
}

TEST(ReplayBuffer, UniformDrawsAllAlikeWithWeightsOfOne) {
  PrioritizedReplayBuffer buffer(kNumberedSize, {.capacity = 100, .prioritized = false});
  buffer.insert(numbered_episode(5, 0), 1);
  buffer.insert(numbered_episode(5, 1), 3);
  buffer.update_priorities(Indices{0}, Errors{1000.0F});
  std::vector<double> weights(5, 1.0);
  weights.resize(10, 3.0);
  EXPECT_LT(chi_square(draws(buffer, 1, 50'000), weights), 27.9);
  RandomStream random(1);
  ReplayBatch batch;
  buffer.sample(8, 1.0, random, batch);
  EXPECT_EQ(batch.weight, std::vector<float>(8, 1.0F));
}

TEST(ReplayBuffer, NewTransitionsGetTheLargestPrioritySoFar) {
  PrioritizedReplayBuffer buffer(kNumberedSize, {.capacity = 100, .alpha = 0.5});
  buffer.insert(numbered_episode(1, 0), 1);
  buffer.update_priorities(Indices{0}, Errors{4.0F});
  buffer.update_priorities(Indices{0}, Errors{1.0F});  // the maximum stays
  buffer.insert(numbered_episode(1, 1), 1);
  const ReplayState state = buffer.snapshot();
  EXPECT_NEAR(state.leaves[0], 1.0, 1e-5);
  EXPECT_NEAR(state.leaves[1], 2.0, 1e-5);
}

TEST(ReplayBuffer, AnErrorThatIsNoNumberDoesNoHarm) {
  PrioritizedReplayBuffer buffer(kNumberedSize, {.capacity = 100, .alpha = 0.5});
  buffer.insert(numbered_episode(4, 0), 1);
  const float infinite = std::numeric_limits<float>::infinity();
  buffer.update_priorities(Indices{0, 1, 2, 3}, Errors{std::nanf(""), infinite, 3e38F, 0.0F});
  const ReplayState state = buffer.snapshot();
  EXPECT_EQ(state.leaves[0], 1.0F);
  EXPECT_EQ(state.leaves[1], 1.0F);
  EXPECT_TRUE(std::isfinite(state.leaves[2]));
  EXPECT_GT(state.leaves[3], 0.0F);
}

TEST(ReplayBuffer, TheOldestTransitionsLeaveWithAllTheirCopies) {
  PrioritizedReplayBuffer buffer(kNumberedSize, {.capacity = 12});
  buffer.insert(numbered_episode(2, 0), 5, 70);
  EXPECT_EQ(buffer.size(), 10U);
  buffer.insert(numbered_episode(2, 1), 1, 71);
  EXPECT_EQ(buffer.size(), 12U);
  EXPECT_EQ(buffer.snapshot().first, 0U);
  buffer.insert(numbered_episode(1, 2), 1, 72);
  EXPECT_EQ(buffer.size(), 8U);
  const ReplayState state = buffer.snapshot();
  EXPECT_EQ(state.first, 1U);
  ASSERT_EQ(state.episodes.size(), 3U);
  EXPECT_EQ(state.episodes[0].tag, 70U);
  EXPECT_EQ(state.episodes[0].evicted, 1U);
  EXPECT_EQ(state.episodes[0].copies, 5U);
  EXPECT_EQ(state.episodes[1].evicted, 0U);
}

TEST(ReplayBuffer, OfAnEpisodeLongerThanTheBufferTheLastTransitionsStay) {
  PrioritizedReplayBuffer buffer(kNumberedSize, {.capacity = 10});
  buffer.insert(numbered_episode(5000, 3), 2);
  EXPECT_EQ(buffer.size(), 10U);
  const auto seen = draws(buffer, 50, 10);
  EXPECT_EQ(seen.begin()->first, 4995U);
  EXPECT_EQ(seen.rbegin()->first, 4999U);
}

TEST(ReplayBuffer, AddsUpTheRewardsOfNStepsByHand) {
  PrioritizedReplayBuffer buffer(kNumberedSize, {.capacity = 10, .n_step = 3, .gamma = 0.5});
  buffer.insert(numbered_episode(5, 0), 1);  // rewards 1 2 3 4 5
  RandomStream random(1);
  ReplayBatch batch;
  buffer.sample(200, 1.0, random, batch);
  const std::vector<float> returns{1 + 2 * .5F + 3 * .25F, 2 + 3 * .5F + 4 * .25F,
                                   3 + 4 * .5F + 5 * .25F, 4 + 5 * .5F, 5};
  const std::vector<float> discounts{0.125F, 0.125F, 0, 0, 0};
  const std::vector<float> to_end{3.5625F, 5.125F, 6.25F, 6.5F, 5};
  for (std::size_t i = 0; i < batch.size; ++i) {
    const std::size_t t = batch.index[i];
    EXPECT_FLOAT_EQ(batch.returns[i], returns[t]);
    EXPECT_FLOAT_EQ(batch.discount[i], discounts[t]);
    EXPECT_FLOAT_EQ(batch.to_end[i], to_end[t]);
    EXPECT_EQ(batch.features[i * 3 + 1], static_cast<float>(t));
    // Behind the end there is no next state; its place holds the state itself.
    EXPECT_EQ(batch.next_features[i * 3 + 1], static_cast<float>(t < 2 ? t + 3 : t));
  }
}

TEST(ReplayBuffer, MemoryGrowsWithWhatIsStoredAndIsUsedAgain) {
  const ObservationSize large{.features = 500, .tokens = 40, .actions = 16};
  PrioritizedReplayBuffer buffer(large, {.capacity = 1'000'000});
  EXPECT_EQ(buffer.bytes(), 0U);
  Episode episode;
  episode.observation = large;
  for (int t = 0; t < 100; ++t) {
    episode.add(std::vector<float>(500), std::vector<std::uint8_t>(40),
                std::vector<std::uint8_t>(16), 0);
  }
  buffer.insert(episode, 1);
  EXPECT_LT(buffer.bytes(), 3'000'000U);
  PrioritizedReplayBuffer small(large, {.capacity = 1000});
  for (int i = 0; i < 50; ++i) small.insert(episode, 5);
  EXPECT_LT(small.bytes(), 6'000'000U);
}

TEST(ReplayBuffer, RefusesWhatDoesNotFit) {
  PrioritizedReplayBuffer buffer(kNumberedSize, {.capacity = 10});
  RandomStream random(1);
  ReplayBatch batch;
  EXPECT_THROW(buffer.sample(1, 1.0, random, batch), std::logic_error);
  EXPECT_THROW(buffer.insert(numbered_episode(2, 0), 0), std::invalid_argument);
  EXPECT_THROW(buffer.insert(numbered_episode(2, 0), 11), std::invalid_argument);
  Episode other = numbered_episode(2, 0);
  other.observation.features = 4;
  EXPECT_THROW(buffer.insert(other, 1), std::invalid_argument);
  EXPECT_TRUE(buffer.empty());
  EXPECT_THROW(PrioritizedReplayBuffer(kNumberedSize, {.capacity = 0}), std::invalid_argument);
  EXPECT_THROW(PrioritizedReplayBuffer(kNumberedSize, {.alpha = std::nan("")}),
               std::invalid_argument);
}

}  // namespace
}  // namespace linewright
