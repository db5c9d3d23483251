#include "linewright/training/replay_buffer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "replay_storage.hpp"

namespace linewright {
namespace {

constexpr std::size_t kMostCapacity = 100'000'000;
constexpr std::size_t kMostSteps = 1000;
/// Priorities between these keep n p^alpha and the importance weights well within a float.
constexpr double kLargestPriority = 1e9;
constexpr double kSmallestPriority = 1e-12;

const ReplayOptions& checked(const ReplayOptions& o) {
  const bool in_range = o.capacity >= 1 && o.capacity <= kMostCapacity && o.alpha >= 0.0 &&
                        o.alpha <= 1.0 && o.epsilon >= kSmallestPriority &&
                        o.epsilon <= kLargestPriority && o.n_step >= 1 && o.n_step <= kMostSteps &&
                        o.gamma >= 0.0 && o.gamma <= 1.0;
  if (!in_range) throw std::invalid_argument("the replay buffer's options are out of range");
  return o;
}

/// Return and bootstrap of transition `t`: rewards up to n_step or the end, whichever is first.
TransitionFacts facts_of(const Episode& episode, std::size_t t, const ReplayOptions& options) {
  const std::size_t end = std::min(episode.size(), t + options.n_step);
  double sum = 0.0;
  double factor = 1.0;
  for (std::size_t k = t; k < end; ++k) {
    sum += factor * static_cast<double>(episode.reward[k]);
    factor *= options.gamma;
  }
  const bool has_next = t + options.n_step < episode.size();
  return {.returns = static_cast<float>(sum),
          .discount = has_next ? static_cast<float>(factor) : 0.0F,
          .action = episode.action[t],
          .next = static_cast<std::uint16_t>(has_next ? options.n_step : 0)};
}

/// The discounted sum of all rewards from each transition on.
std::vector<float> returns_to_end(const Episode& episode, double gamma) {
  std::vector<float> sums(episode.size());
  double sum = 0.0;
  for (std::size_t t = episode.size(); t-- > 0;) {
    sum = static_cast<double>(episode.reward[t]) + gamma * sum;
    sums[t] = static_cast<float>(sum);
  }
  return sums;
}

double to_power(double base, double exponent) {
  return exponent == 0.5 ? std::sqrt(base) : std::pow(base, exponent);
}

void resize(ReplayBatch& batch, std::size_t count, const ObservationSize& observation) {
  batch.size = count;
  batch.features.resize(count * observation.features);
  batch.present.resize(count * observation.tokens);
  batch.action.resize(count);
  batch.returns.resize(count);
  batch.to_end.resize(count);
  batch.discount.resize(count);
  batch.next_features.resize(count * observation.features);
  batch.next_present.resize(count * observation.tokens);
  batch.next_selectable.resize(count * observation.actions);
  batch.weight.resize(count);
  batch.index.resize(count);
}

}  // namespace

PrioritizedReplayBuffer::PrioritizedReplayBuffer(const ObservationSize& observation,
                                                 const ReplayOptions& options)
    : options_(checked(options)),
      // One more: a new transition comes before the oldest one goes.
      storage_(std::make_unique<ReplayStorage>(observation, options.capacity + 1)),
      tree_(storage_->ring()) {}

PrioritizedReplayBuffer::~PrioritizedReplayBuffer() = default;
PrioritizedReplayBuffer::PrioritizedReplayBuffer(PrioritizedReplayBuffer&&) noexcept = default;
PrioritizedReplayBuffer& PrioritizedReplayBuffer::operator=(PrioritizedReplayBuffer&&) noexcept =
    default;

std::size_t PrioritizedReplayBuffer::bytes() const { return storage_->bytes(); }

void PrioritizedReplayBuffer::insert(const Episode& episode, std::size_t copies,
                                     std::uint64_t tag) {
  check_episode(episode);
  if (!(episode.observation == storage_->observation())) {
    throw std::invalid_argument("the episode has another observation than the buffer");
  }
  if (copies < 1 || copies > options_.capacity) {
    throw std::invalid_argument("a transition is stored at least once and at most capacity times");
  }
  append(episode, 0, static_cast<std::uint32_t>(copies), tag);
}

/// Stores the transitions of `episode` from number `from` on.
void PrioritizedReplayBuffer::append(const Episode& episode, std::uint64_t from,
                                     std::uint32_t copies, std::uint64_t tag) {
  if (from >= episode.size()) return;
  episodes_.push_back({tag, next_, next_ + (episode.size() - from), from, copies});
  const float weight = leaf_weight(largest_, copies);
  const std::vector<float> to_end = returns_to_end(episode, options_.gamma);
  for (std::size_t row = from; row < episode.size(); ++row) {
    TransitionFacts facts = facts_of(episode, row, options_);
    facts.copies = copies;
    facts.to_end = to_end[row];
    storage_->store(next_, episode, row, facts);
    tree_.set(leaf_of(next_), weight);
    ++next_;
    copies_ += copies;
    while (copies_ > options_.capacity) evict_oldest();
  }
}

void PrioritizedReplayBuffer::evict_oldest() {
  copies_ -= storage_->facts(first_).copies;
  tree_.set(leaf_of(first_), 0.0F);
  ++first_;
  storage_->forget_before(first_);
  if (episodes_.front().end <= first_) episodes_.pop_front();
}

std::uint64_t PrioritizedReplayBuffer::index_of(std::size_t leaf) const {
  const std::uint64_t index = first_ - first_ % tree_.size() + leaf;
  return index < first_ ? index + tree_.size() : index;
}

float PrioritizedReplayBuffer::leaf_weight(double scaled_priority, std::uint32_t copies) const {
  const double scaled = options_.prioritized ? scaled_priority : 1.0;
  return static_cast<float>(copies * scaled);
}

void PrioritizedReplayBuffer::sample(std::size_t count, double beta, RandomStream& random,
                                     ReplayBatch& batch) {
  if (empty()) throw std::logic_error("nothing can be drawn from an empty replay buffer");
  resize(batch, count, storage_->observation());
  draw(count, random, batch);
  for (std::size_t i = 0; i < count; ++i) storage_->gather(i, batch);
  weigh(beta, batch);
}

void PrioritizedReplayBuffer::draw(std::size_t count, RandomStream& random, ReplayBatch& batch) {
  const double part = tree_.total() / static_cast<double>(count);
  prefixes_.resize(count);
  leaves_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    prefixes_[i] = (static_cast<double>(i) + random.uniform()) * part;
  }
  tree_.find(prefixes_, leaves_);
  for (std::size_t i = 0; i < count; ++i) {
    batch.index[i] = index_of(leaves_[i]);
    storage_->prefetch(batch.index[i]);
  }
}

void PrioritizedReplayBuffer::weigh(double beta, ReplayBatch& batch) const {
  if (!options_.prioritized) {
    std::fill(batch.weight.begin(), batch.weight.end(), 1.0F);
    return;
  }
  const double per_weight = static_cast<double>(copies_) / tree_.total();
  float largest = 0.0F;
  for (std::size_t i = 0; i < batch.size; ++i) {
    const std::uint64_t index = batch.index[i];
    const double of_one_copy =
        static_cast<double>(tree_[leaf_of(index)]) / storage_->facts(index).copies;
    batch.weight[i] = static_cast<float>(std::pow(of_one_copy * per_weight, -beta));
    largest = std::max(largest, batch.weight[i]);
  }
  for (float& weight : batch.weight) weight /= largest;
}

void PrioritizedReplayBuffer::update_priorities(std::span<const std::uint64_t> index,
                                                std::span<const float> td_errors) {
  if (!options_.prioritized) return;
  leaves_.clear();
  weights_.clear();
  for (std::size_t i = 0; i < std::min(index.size(), td_errors.size()); ++i) {
    if (index[i] < first_ || index[i] >= next_) continue;  // evicted meanwhile
    double scaled = largest_;
    if (std::isfinite(td_errors[i])) {
      const double error = std::abs(static_cast<double>(td_errors[i]));
      scaled = to_power(std::min(error + options_.epsilon, kLargestPriority), options_.alpha);
      largest_ = std::max(largest_, scaled);
    }
    leaves_.push_back(leaf_of(index[i]));
    weights_.push_back(leaf_weight(scaled, storage_->facts(index[i]).copies));
  }
  tree_.set(leaves_, weights_);
}

}  // namespace linewright
