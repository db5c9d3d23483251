// What of a replay buffer goes into a checkpoint, and back.

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "linewright/training/replay_buffer.hpp"
#include "replay_storage.hpp"

namespace linewright {
namespace {

constexpr std::uint64_t kMostIndex = std::uint64_t{1} << 62;

void refuse(const char* what) { throw std::invalid_argument(what); }

/// What can be told without the episodes.
void check_state(const ReplayState& state, const ReplayOptions& options) {
  if (state.first > state.next || state.next > kMostIndex ||
      state.next - state.first > options.capacity) {
    refuse("the replay state holds more transitions than the buffer");
  }
  if (state.leaves.size() != state.next - state.first) {
    refuse("the replay state has not one weight for each transition");
  }
  const auto is_bad = [](float leaf) { return !std::isfinite(leaf) || !(leaf > 0.0F); };
  if (std::any_of(state.leaves.begin(), state.leaves.end(), is_bad) ||
      !std::isfinite(state.largest) || state.largest < 0.0) {
    refuse("the replay state has a weight that is no positive number");
  }
}

}  // namespace

ReplayState PrioritizedReplayBuffer::snapshot() const {
  ReplayState state{.first = first_, .next = next_, .largest = largest_};
  state.episodes.reserve(episodes_.size());
  for (const StoredEpisode& stored : episodes_) {
    const std::uint64_t gone = first_ > stored.first ? first_ - stored.first : 0;
    state.episodes.push_back({stored.tag, stored.copies, stored.skipped + gone});
  }
  state.leaves.reserve(transitions());
  for (std::uint64_t index = first_; index < next_; ++index) {
    state.leaves.push_back(tree_[leaf_of(index)]);
  }
  return state;
}

/// Empties the buffer; the next transition gets `index`.
void PrioritizedReplayBuffer::clear(std::uint64_t index) {
  storage_->clear(index);
  tree_ = SumTree(storage_->ring());
  episodes_.clear();
  first_ = next_ = index;
  copies_ = 0;
  largest_ = 1.0;
}

void PrioritizedReplayBuffer::rebuild(const ReplayState& state, const EpisodeProvider& provider) {
  check_state(state, options_);
  clear(state.first);
  for (const ReplayEpisode& stored : state.episodes) {
    const Episode episode = provider(stored.tag);
    check_episode(episode);
    if (!(episode.observation == storage_->observation())) {
      refuse("the episode has another observation than the buffer");
    }
    const std::size_t room = options_.capacity - copies_;
    const bool fits = stored.evicted < episode.size() && stored.copies >= 1 &&
                      (episode.size() - stored.evicted) <= room / stored.copies;
    if (!fits) refuse("an episode of the replay state has another length than it had");
    append(episode, stored.evicted, stored.copies, stored.tag);
  }
  if (next_ != state.next) refuse("the episodes of the replay state have other lengths");
  for (std::uint64_t index = first_; index < next_; ++index) {
    tree_.set(leaf_of(index), state.leaves[index - first_]);
  }
  largest_ = state.largest;
}

void PrioritizedReplayBuffer::restore(const ReplayState& state, const EpisodeProvider& provider) {
  try {
    rebuild(state, provider);
  } catch (...) {
    clear(0);
    throw;
  }
}

}  // namespace linewright
