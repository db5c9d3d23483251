#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "linewright/base/random.hpp"
#include "linewright/training/episode.hpp"
#include "linewright/training/sum_tree.hpp"

namespace linewright {

class ReplayStorage;

/// How transitions are kept and drawn (Schaul et al., Prioritized Experience Replay, 2015).
struct ReplayOptions {
  std::size_t capacity = 500'000;  ///< transitions, copies counted; 1 to 100 million
  bool prioritized = true;         ///< false: every copy is equally likely, all weights are 1
  double alpha = 0.5;              ///< exponent of the priority, 0 (uniform) to 1
  double epsilon = 1e-6;           ///< added to |TD error|, >= 1e-12: nothing becomes unreachable
  std::size_t n_step = 1;          ///< rewards added up before the bootstrap, 1 to 1000
  double gamma = 0.99;             ///< discount per decision, 0 to 1
};

/// A drawn batch, row by row. The caller keeps it and passes it again: its memory is reused.
struct ReplayBatch {
  std::size_t size = 0;
  std::vector<float> features;        ///< [size x features]
  std::vector<std::uint8_t> present;  ///< [size x tokens]
  std::vector<std::int64_t> action;   ///< [size]
  std::vector<float> returns;         ///< sum of gamma^k r_{t+1+k}, k < n_step, to the end
  std::vector<float> to_end;          ///< the same to the end of the episode: what was reached
  std::vector<float> discount;        ///< of the bootstrap: gamma^n_step; 0: ended before
  std::vector<float> next_features;   ///< where the discount is 0: those of the state itself
  std::vector<std::uint8_t> next_present;
  std::vector<std::uint8_t> next_selectable;  ///< [size x actions]
  std::vector<float> weight;                  ///< importance, (N P)^-beta / largest of the batch
  std::vector<std::uint64_t> index;  ///< for update_priorities; never given to another transition
};

/// One episode of which at least one transition is still in the buffer.
struct ReplayEpisode {
  std::uint64_t tag = 0;      ///< the caller's name for it
  std::uint32_t copies = 1;   ///< of each of its transitions
  std::uint64_t evicted = 0;  ///< how many of its transitions are gone, from the front
};

/// Everything about a buffer except the observations, which the caller can make again.
struct ReplayState {
  std::uint64_t first = 0;              ///< index of the oldest transition still there
  std::uint64_t next = 0;               ///< index that the next transition gets
  std::vector<ReplayEpisode> episodes;  ///< oldest first
  std::vector<float> leaves;            ///< sampling weights, by transition from `first` on
  double largest = 1.0;                 ///< running maximum of priority^alpha
};

/// Prioritised experience replay with multiplicities. A transition that is stored n times is kept
/// once, with one priority p: it is drawn with n p^alpha / (sum of all), exactly as n equal copies
/// together would be, and its importance weight is that of one copy. N counts copies, and so does
/// the capacity. The oldest transitions leave first, all copies at once.
///
/// Observations are stored once: the next state of a transition is a later row of its episode.
/// Memory grows in chunks of 1024 transitions and is used again after eviction; beside it the
/// buffer takes 5 bytes per transition of its capacity. Not thread-safe.
class PrioritizedReplayBuffer {
 public:
  /// Throws std::invalid_argument for options out of range.
  PrioritizedReplayBuffer(const ObservationSize& observation, const ReplayOptions& options);
  ~PrioritizedReplayBuffer();
  PrioritizedReplayBuffer(PrioritizedReplayBuffer&&) noexcept;
  PrioritizedReplayBuffer& operator=(PrioritizedReplayBuffer&&) noexcept;

  /// Stores a whole episode, each transition `copies` times (1 to capacity), with the largest
  /// priority seen so far, and evicts what is too old. `tag` is what snapshot() will call it. There
  /// is no bootstrap behind its last decision. Throws std::invalid_argument, and stores nothing,
  /// when the episode is not of the buffer's observation or `copies` is out of range.
  void insert(const Episode& episode, std::size_t copies, std::uint64_t tag = 0);

  /// Stored transitions, copies counted and not.
  [[nodiscard]] std::size_t size() const { return copies_; }
  [[nodiscard]] std::size_t transitions() const { return static_cast<std::size_t>(next_ - first_); }
  [[nodiscard]] bool empty() const { return first_ == next_; }
  /// Bytes held for observations.
  [[nodiscard]] std::size_t bytes() const;
  [[nodiscard]] const ReplayOptions& options() const { return options_; }

  /// Draws `count` transitions, stratified: one from each `count`-th part of the total weight.
  /// `beta` (0 to 1) is how far the importance weights undo the bias. Throws std::logic_error when
  /// the buffer is empty.
  void sample(std::size_t count, double beta, RandomStream& random, ReplayBatch& batch);

  /// Sets the priorities |TD error| + epsilon of sampled transitions. One that was evicted
  /// meanwhile is left out; of one named twice the last error counts. An error that is not finite
  /// gives the largest priority so far. Without effect on a uniform buffer.
  void update_priorities(std::span<const std::uint64_t> index, std::span<const float> td_errors);

  [[nodiscard]] ReplayState snapshot() const;

  /// Gives the episode of a tag, with the same decisions and rewards as when it was inserted.
  using EpisodeProvider = std::function<Episode(std::uint64_t tag)>;
  /// Takes over a snapshot of a buffer with the same options; sampling then goes on as if it had
  /// never been interrupted, bit for bit. Throws std::invalid_argument, and leaves the buffer
  /// empty, when the state contradicts itself or an episode does not fit.
  void restore(const ReplayState& state, const EpisodeProvider& provider);

 private:
  struct StoredEpisode {
    std::uint64_t tag = 0;
    std::uint64_t first = 0;    ///< index of the first transition that was stored
    std::uint64_t end = 0;      ///< behind its last one
    std::uint64_t skipped = 0;  ///< transitions before `first`, gone before a restart
    std::uint32_t copies = 1;
  };

  void clear(std::uint64_t index);
  void rebuild(const ReplayState& state, const EpisodeProvider& provider);
  void append(const Episode& episode, std::uint64_t from, std::uint32_t copies, std::uint64_t tag);
  void evict_oldest();
  [[nodiscard]] std::size_t leaf_of(std::uint64_t index) const { return index % tree_.size(); }
  [[nodiscard]] std::uint64_t index_of(std::size_t leaf) const;
  void draw(std::size_t count, RandomStream& random, ReplayBatch& batch);
  void weigh(double beta, ReplayBatch& batch) const;
  [[nodiscard]] float leaf_weight(double scaled_priority, std::uint32_t copies) const;

  ReplayOptions options_;
  std::unique_ptr<ReplayStorage> storage_;
  SumTree tree_;
  std::deque<StoredEpisode> episodes_;
  std::uint64_t first_ = 0;
  std::uint64_t next_ = 0;
  std::size_t copies_ = 0;
  double largest_ = 1.0;             ///< running maximum of priority^alpha
  std::vector<std::size_t> leaves_;  ///< of a batch
  std::vector<float> weights_;
  std::vector<double> prefixes_;
};

}  // namespace linewright
