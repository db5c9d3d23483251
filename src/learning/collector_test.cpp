#include "collector.hpp"

#include <gtest/gtest.h>

#include "episode_replay.hpp"
#include "linewright/scenario/load.hpp"

namespace linewright::learning {
namespace {

constexpr PauseOptions kOften{.episodes = 1.0, .decisions = 0.2, .most = 50};

/// Some episodes of random decisions on the duct line.
class Collected : public testing::Test {
 protected:
  std::vector<FinishedEpisode> collect(const PauseOptions& pauses) {
    VectorEnvironment environments(simulator_, plan_, "sap", {}, 4, pool_, pauses);
    Collector collector(environments, pool_, 1);
    collector.start();
    std::vector<FinishedEpisode> finished;
    while (finished.size() < 20) collector.collect({}, finished);
    return finished;
  }

  Simulator simulator_{std::make_shared<const LineModel>(
      load_scenario(LINEWRIGHT_SOURCE_DIR "/scenarios/duct_line.yaml").line)};
  EpisodePlan plan_{.crews = {RunOptions{.workers = {2, 2}}}, .seed = 3};
  WorkerPool pool_{1};
};

TEST_F(Collected, KeepEveryDecisionWithoutPauses) {
  for (const FinishedEpisode& finished : collect({})) {
    EXPECT_EQ(finished.episode.action, finished.actions);
  }
}

TEST_F(Collected, KeepOnlyWhatFollowsTheLastPause) {
  std::size_t kept = 0;
  std::size_t all = 0;
  for (const FinishedEpisode& finished : collect(kOften)) {
    const std::vector<std::uint16_t>& left = finished.episode.action;
    ASSERT_LE(left.size(), finished.actions.size());
    EXPECT_TRUE(std::equal(left.rbegin(), left.rend(), finished.actions.rbegin()));
    EXPECT_EQ(finished.episode.reward.size(), left.size());
    kept += left.size();
    all += finished.actions.size();
  }
  EXPECT_GT(kept, 0U);
  EXPECT_LT(kept, all / 2);
}

TEST_F(Collected, ArePlayedAgainFromTheirDecisions) {
  EpisodeReplayer replayer(simulator_, plan_, "sap", {}, kOften);
  for (const FinishedEpisode& finished : collect(kOften)) {
    const Episode again = replayer.play(finished.number, finished.actions);
    EXPECT_EQ(again.action, finished.episode.action);
    EXPECT_EQ(again.reward, finished.episode.reward);
    EXPECT_EQ(again.features, finished.episode.features);
    EXPECT_EQ(again.outcome.makespan, finished.episode.outcome.makespan);
  }
}

}  // namespace
}  // namespace linewright::learning
