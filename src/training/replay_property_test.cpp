// The replay buffer beside a plain list of copies that does everything in the most obvious way.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <vector>

#include "linewright/training/replay_buffer.hpp"
#include "numbered_episode.hpp"

namespace linewright {
namespace {

/// One stored copy, with its whole next state.
struct Copy {
  std::uint64_t transition = 0;
  std::vector<float> state;
  std::vector<float> next;  ///< empty behind the end
  float action = 0;
  double returns = 0.0;
  double priority = 1.0;  ///< to the power alpha
};

class PlainBuffer {
 public:
  explicit PlainBuffer(const ReplayOptions& options) : options_(options) {}

  void insert(const Episode& episode, std::size_t copies) {
    for (std::size_t t = 0; t < episode.size(); ++t) {
      Copy one{.transition = next_++, .state = row(episode, t), .priority = largest_};
      one.action = episode.action[t];
      for (std::size_t k = 0; k < options_.n_step && t + k < episode.size(); ++k) {
        one.returns += std::pow(options_.gamma, static_cast<double>(k)) *
                       static_cast<double>(episode.reward[t + k]);
      }
      if (t + options_.n_step < episode.size()) one.next = row(episode, t + options_.n_step);
      for (std::size_t c = 0; c < copies; ++c) copies_.push_back(one);
      while (copies_.size() > options_.capacity) evict();
    }
  }

  void update(std::uint64_t transition, float error) {
    const double priority =
        std::pow(std::abs(static_cast<double>(error)) + options_.epsilon, options_.alpha);
    bool there = false;
    for (Copy& copy : copies_) {
      if (copy.transition != transition) continue;
      copy.priority = priority;
      there = true;
    }
    if (there) largest_ = std::max(largest_, priority);
  }

  [[nodiscard]] const std::deque<Copy>& copies() const { return copies_; }

 private:
  static std::vector<float> row(const Episode& episode, std::size_t t) {
    return {episode.features[t * 3], episode.features[t * 3 + 1], episode.features[t * 3 + 2]};
  }
  void evict() {
    const std::uint64_t oldest = copies_.front().transition;
    while (!copies_.empty() && copies_.front().transition == oldest) copies_.pop_front();
  }

  ReplayOptions options_;
  std::deque<Copy> copies_;
  std::uint64_t next_ = 0;
  double largest_ = 1.0;
};

void expect_same_rows(const ReplayBatch& batch, const PlainBuffer& plain,
                      const ReplayOptions& options) {
  std::map<std::uint64_t, const Copy*> by_transition;
  double total = 0.0;
  for (const Copy& copy : plain.copies()) {
    by_transition[copy.transition] = &copy;
    total += copy.priority;
  }
  double largest = 0.0;
  std::vector<double> importance;
  for (std::size_t i = 0; i < batch.size; ++i) {
    ASSERT_TRUE(by_transition.contains(batch.index[i])) << "evicted or never stored";
    const Copy& copy = *by_transition[batch.index[i]];
    const bool has_next = !copy.next.empty();
    for (std::size_t f = 0; f < 3; ++f) {
      ASSERT_EQ(batch.features[i * 3 + f], copy.state[f]);
      ASSERT_EQ(batch.next_features[i * 3 + f], has_next ? copy.next[f] : copy.state[f]);
    }
    const auto number = static_cast<std::size_t>(batch.next_features[i * 3]);
    const auto t = static_cast<std::size_t>(batch.next_features[i * 3 + 1]);
    ASSERT_EQ(batch.next_selectable[i * 5 + (number + t) % 5], 1);
    ASSERT_EQ(batch.next_present[i * 2], t % 2);
    ASSERT_EQ(batch.present[i * 2 + 1], 1);
    ASSERT_EQ(static_cast<float>(batch.action[i]), copy.action);
    ASSERT_NEAR(batch.returns[i], copy.returns, 1e-3);
    const double discount = std::pow(options.gamma, static_cast<double>(options.n_step));
    ASSERT_NEAR(batch.discount[i], has_next ? discount : 0.0, 1e-6);
    const double chance = copy.priority / total;
    importance.push_back(std::pow(static_cast<double>(plain.copies().size()) * chance, -0.4));
    largest = std::max(largest, importance.back());
  }
  for (std::size_t i = 0; i < batch.size; ++i) {
    ASSERT_NEAR(batch.weight[i], importance[i] / largest, 1e-4);
  }
}

void play(std::uint64_t seed) {
  RandomStream random(seed);
  const ReplayOptions options{.capacity = 1 + random.below(3000),
                              .alpha = random.uniform(),
                              .n_step = 1 + random.below(4),
                              .gamma = random.uniform()};
  PrioritizedReplayBuffer buffer(kNumberedSize, options);
  PlainBuffer plain(options);
  ReplayBatch batch;
  std::vector<float> errors;
  for (std::size_t round = 0; round < 60; ++round) {
    const Episode episode = numbered_episode(random.below(300), round);
    const std::size_t copies = 1 + random.below(std::min<std::size_t>(options.capacity, 5));
    buffer.insert(episode, copies);
    plain.insert(episode, copies);
    ASSERT_EQ(buffer.size(), plain.copies().size());
    // Of the last batch, part of which may have been evicted by now.
    errors.resize(batch.index.size());
    for (float& error : errors) error = static_cast<float>(random.uniform() * 4.0 - 2.0);
    buffer.update_priorities(batch.index, errors);
    for (std::size_t i = 0; i < errors.size(); ++i) plain.update(batch.index[i], errors[i]);
    if (buffer.empty()) continue;
    buffer.sample(1 + random.below(40), 0.4, random, batch);
    expect_same_rows(batch, plain, options);
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(ReplayBuffer, AgreesWithAPlainListWhateverIsDone) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE(seed);
    play(seed);
    if (testing::Test::HasFatalFailure()) return;
  }
}

}  // namespace
}  // namespace linewright
