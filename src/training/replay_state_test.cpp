#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

#include "linewright/training/replay_buffer.hpp"
#include "numbered_episode.hpp"

namespace linewright {
namespace {

constexpr ReplayOptions kOptions{.capacity = 2500, .n_step = 2};

Episode episode_of(std::uint64_t tag) {
  RandomStream random = RandomStream::derive(1, "episode", tag);
  return numbered_episode(1 + random.below(200), tag);
}

/// One round of learning: an episode more, a batch, new priorities.
void learn(PrioritizedReplayBuffer& buffer, RandomStream& random, std::uint64_t tag,
           ReplayBatch& batch) {
  buffer.insert(episode_of(tag), tag % 3 == 0 ? 5 : 1, tag);
  buffer.sample(32, 0.5, random, batch);
  std::vector<float> errors(batch.size);
  for (float& error : errors) error = static_cast<float>(random.uniform());
  buffer.update_priorities(batch.index, errors);
}

/// A buffer in use: old episodes are gone, one of them in part.
PrioritizedReplayBuffer used_buffer(RandomStream& random) {
  PrioritizedReplayBuffer buffer(kNumberedSize, kOptions);
  ReplayBatch batch;
  for (std::uint64_t tag = 0; tag < 60; ++tag) learn(buffer, random, tag, batch);
  return buffer;
}

TEST(ReplayState, SamplingGoesOnBitForBitAfterARestart) {
  RandomStream random(5);
  PrioritizedReplayBuffer original = used_buffer(random);
  const ReplayState state = original.snapshot();
  ASSERT_GT(state.first, 0U);
  ASSERT_GT(state.episodes.front().evicted, 0U);
  PrioritizedReplayBuffer restored(kNumberedSize, kOptions);
  restored.insert(numbered_episode(7, 3), 1);  // what was there before does not matter
  restored.restore(state, episode_of);
  EXPECT_EQ(restored.size(), original.size());
  RandomStream same_random = random;
  ReplayBatch a;
  ReplayBatch b;
  for (std::uint64_t tag = 60; tag < 200; ++tag) {
    learn(original, random, tag, a);
    learn(restored, same_random, tag, b);
    ASSERT_EQ(a.index, b.index);
    ASSERT_EQ(a.weight, b.weight);
    ASSERT_EQ(a.features, b.features);
    ASSERT_EQ(a.next_features, b.next_features);
    ASSERT_EQ(a.returns, b.returns);
    ASSERT_EQ(a.discount, b.discount);
    ASSERT_EQ(a.action, b.action);
  }
}

TEST(ReplayState, ASnapshotOfARestoredBufferIsTheSame) {
  RandomStream random(6);
  const ReplayState state = used_buffer(random).snapshot();
  PrioritizedReplayBuffer restored(kNumberedSize, kOptions);
  restored.restore(state, episode_of);
  const ReplayState again = restored.snapshot();
  EXPECT_EQ(again.first, state.first);
  EXPECT_EQ(again.next, state.next);
  EXPECT_EQ(again.leaves, state.leaves);
  EXPECT_EQ(again.largest, state.largest);
  ASSERT_EQ(again.episodes.size(), state.episodes.size());
  for (std::size_t i = 0; i < state.episodes.size(); ++i) {
    EXPECT_EQ(again.episodes[i].tag, state.episodes[i].tag);
    EXPECT_EQ(again.episodes[i].copies, state.episodes[i].copies);
    EXPECT_EQ(again.episodes[i].evicted, state.episodes[i].evicted);
  }
}

TEST(ReplayState, AnEmptyBufferCanBeRestored) {
  PrioritizedReplayBuffer buffer(kNumberedSize, kOptions);
  buffer.restore(PrioritizedReplayBuffer(kNumberedSize, kOptions).snapshot(), episode_of);
  EXPECT_TRUE(buffer.empty());
}

TEST(ReplayState, RefusesStatesThatContradictThemselves) {
  RandomStream random(8);
  const ReplayState sound = used_buffer(random).snapshot();
  PrioritizedReplayBuffer buffer(kNumberedSize, kOptions);
  const auto expect_refused = [&](const char* what, auto damage) {
    ReplayState state = sound;
    damage(state);
    EXPECT_THROW(buffer.restore(state, episode_of), std::invalid_argument) << what;
    EXPECT_TRUE(buffer.empty()) << what;
  };
  expect_refused("a weight too few", [](ReplayState& s) { s.leaves.pop_back(); });
  expect_refused("a negative weight", [](ReplayState& s) { s.leaves[3] = -1.0F; });
  expect_refused("backwards", [](ReplayState& s) { s.next = s.first - 1; });
  expect_refused("far too many", [](ReplayState& s) { s.next = s.first + (1ULL << 40); });
  expect_refused("close to overflow", [](ReplayState& s) {
    s.first += ~0ULL - s.next;
    s.next = ~0ULL;
  });
  expect_refused("an episode too few", [](ReplayState& s) { s.episodes.pop_back(); });
  expect_refused("an episode too many", [](ReplayState& s) { s.episodes.push_back({}); });
  expect_refused("other copies", [](ReplayState& s) { s.episodes.back().copies = 4'000'000; });
  expect_refused("no copies", [](ReplayState& s) { s.episodes.back().copies = 0; });
  expect_refused("all evicted", [](ReplayState& s) { s.episodes.front().evicted = 1ULL << 60; });
  expect_refused("another episode", [](ReplayState& s) { s.episodes.front().tag += 1; });
  EXPECT_NO_THROW(buffer.restore(sound, episode_of));
}

}  // namespace
}  // namespace linewright
