// A tabular Q-learner on a toy chain, fed from the replay buffer alone.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "linewright/training/replay_buffer.hpp"

namespace linewright {
namespace {

constexpr std::size_t kStates = 8;
using Table = std::array<std::array<double, 2>, kStates>;

/// Action 1 leads one state on, action 0 ends the episode; only the end of the chain pays.
Episode walk(RandomStream& random) {
  Episode episode;
  episode.observation = {.features = 1, .tokens = 1, .actions = 2};
  const std::vector<std::uint8_t> present{1};
  const std::vector<std::uint8_t> selectable{1, 1};
  for (std::size_t state = 0; state < kStates; ++state) {
    const std::size_t action = random.below(10) == 0 ? 0 : 1;
    const std::vector<float> features{static_cast<float>(state)};
    episode.add(features, present, selectable, action);
    if (action == 0) return episode;
  }
  episode.reward.back() = 1.0F;
  return episode;
}

Table learn(const ReplayOptions& options) {
  PrioritizedReplayBuffer buffer({.features = 1, .tokens = 1, .actions = 2}, options);
  RandomStream random(3);
  for (int i = 0; i < 50; ++i) buffer.insert(walk(random), 1);
  Table q{};
  ReplayBatch batch;
  std::vector<float> errors;
  for (int update = 0; update < 3000; ++update) {
    buffer.sample(16, 0.5, random, batch);
    errors.assign(batch.size, 0.0F);
    for (std::size_t i = 0; i < batch.size; ++i) {
      const auto& next = q[static_cast<std::size_t>(batch.next_features[i])];
      const double best = std::max(next[0], next[1]);
      const double target =
          static_cast<double>(batch.returns[i]) + static_cast<double>(batch.discount[i]) * best;
      double& value =
          q[static_cast<std::size_t>(batch.features[i])][static_cast<std::size_t>(batch.action[i])];
      errors[i] = static_cast<float>(target - value);
      value += 0.5 * static_cast<double>(batch.weight[i]) * (target - value);
    }
    buffer.update_priorities(batch.index, errors);
  }
  return q;
}

void expect_solved(const ReplayOptions& options) {
  const Table q = learn(options);
  for (std::size_t state = 0; state < kStates; ++state) {
    const double steps = static_cast<double>(kStates - 1 - state);
    EXPECT_NEAR(q[state][1], std::pow(options.gamma, steps), 1e-2) << state;
    EXPECT_NEAR(q[state][0], 0.0, 1e-9) << state;
  }
}

TEST(ReplayLearning, TheTerminalRewardReachesTheFirstDecision) {
  expect_solved({.capacity = 10'000, .gamma = 0.9});
}

TEST(ReplayLearning, ItDoesSoWithoutPrioritiesToo) {
  expect_solved({.capacity = 10'000, .prioritized = false, .gamma = 0.9});
}

TEST(ReplayLearning, WithNStepsTheTerminalRewardItselfIsInTheReturns) {
  PrioritizedReplayBuffer buffer({.features = 1, .tokens = 1, .actions = 2},
                                 {.capacity = 100, .n_step = 20, .gamma = 0.9});
  RandomStream random(4);
  Episode episode = walk(random);
  while (episode.size() < kStates) episode = walk(random);
  buffer.insert(episode, 1);
  ReplayBatch batch;
  buffer.sample(100, 0.5, random, batch);
  for (std::size_t i = 0; i < batch.size; ++i) {
    const double steps = static_cast<double>(kStates - 1) - static_cast<double>(batch.features[i]);
    EXPECT_NEAR(batch.returns[i], std::pow(0.9, steps), 1e-6);
    EXPECT_EQ(batch.discount[i], 0.0F);
  }
}

}  // namespace
}  // namespace linewright
