#include "linewright/training/episode_end.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

#include "linewright/training/episode.hpp"

namespace linewright {
namespace {

/// Three decisions with the rewards 1, 2 and 3.
Episode episode_with(EpisodeOutcome outcome) {
  Episode episode;
  episode.observation = {.features = 2, .tokens = 1, .actions = 4};
  const std::vector<float> features{0.5F, 1.5F};
  const std::vector<std::uint8_t> present{1};
  const std::vector<std::uint8_t> selectable{1, 1, 0, 1};
  for (std::size_t i = 0; i < 3; ++i) {
    episode.add(features, present, selectable, i);
    episode.reward[i] = static_cast<float>(i + 1);
  }
  episode.outcome = outcome;
  return episode;
}

using Rewards = std::vector<float>;

TEST(EpisodeEnd, ASuccessRaisesEveryRewardAndIsCopied) {
  Episode episode = episode_with({.success = true, .makespan = 800, .horizon = 1000});
  EXPECT_EQ(process_episode_end(episode, {}), 5);
  // 0.4 * (1000 - 800) / 800 = 0.1
  EXPECT_EQ(episode.reward, (Rewards{1.1F, 2.1F, 3.1F}));
}

TEST(EpisodeEnd, AFailureLowersEveryRewardAndIsStoredOnce) {
  Episode deadlock = episode_with({.success = false, .makespan = 0, .horizon = 1000});
  EXPECT_EQ(process_episode_end(deadlock, {}), 1);
  EXPECT_EQ(deadlock.reward, (Rewards{0.999F, 1.999F, 2.999F}));
}

TEST(EpisodeEnd, ATimeOutIsAFailure) {
  Episode time_out = episode_with({.success = false, .makespan = 1000, .horizon = 1000});
  EXPECT_EQ(process_episode_end(time_out, {}), 1);
  EXPECT_EQ(time_out.reward, (Rewards{0.999F, 1.999F, 2.999F}));
}

TEST(EpisodeEnd, AFailureKeepsItsPenaltyWhenASuccessFollows) {
  const EpisodeEndOptions options{.eta4 = 1.0, .eta5 = 0.5, .eta6 = 3};
  Episode failure = episode_with({.success = false, .makespan = 0, .horizon = 100});
  Episode success = episode_with({.success = true, .makespan = 50, .horizon = 100});
  EXPECT_EQ(process_episode_end(failure, options), 1);
  EXPECT_EQ(process_episode_end(success, options), 3);
  EXPECT_EQ(failure.reward, (Rewards{0.5F, 1.5F, 2.5F}));
  EXPECT_EQ(success.reward, (Rewards{2.0F, 3.0F, 4.0F}));
}

TEST(EpisodeEnd, WithoutModificationRewardsStayAndSuccessesAreStillCopied) {
  Episode success = episode_with({.success = true, .makespan = 50, .horizon = 100});
  EXPECT_EQ(process_episode_end(success, {.modify = false}), 5);
  EXPECT_EQ(success.reward, (Rewards{1.0F, 2.0F, 3.0F}));
  Episode failure = episode_with({.success = false, .makespan = 0, .horizon = 100});
  EXPECT_EQ(process_episode_end(failure, {.modify = false}), 1);
  EXPECT_EQ(failure.reward, (Rewards{1.0F, 2.0F, 3.0F}));
}

TEST(EpisodeEnd, AnOrderThatWasDoneAtOnceGivesAFiniteReward) {
  Episode episode = episode_with({.success = true, .makespan = 0, .horizon = 100});
  EXPECT_EQ(process_episode_end(episode, {.eta4 = 1.0}), 5);
  EXPECT_EQ(episode.reward, (Rewards{100.0F, 101.0F, 102.0F}));
}

TEST(Episode, ColumnsMustFitTogether) {
  Episode episode = episode_with({});
  EXPECT_NO_THROW(check_episode(episode));
  episode.features.pop_back();
  EXPECT_THROW(check_episode(episode), std::invalid_argument);
  episode = episode_with({});
  episode.action[1] = 4;
  EXPECT_THROW(check_episode(episode), std::invalid_argument);
  episode.clear();
  EXPECT_EQ(episode.size(), 0U);
  EXPECT_NO_THROW(check_episode(episode));
}

}  // namespace
}  // namespace linewright
