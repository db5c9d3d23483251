#include "replay_storage.hpp"

#include <cstring>
#include <utility>

namespace linewright {
namespace {

template <class Value>
void copy_row(const Value* row, std::size_t width, std::vector<Value>& column, std::size_t i) {
  if (width > 0) std::memcpy(&column[i * width], row, width * sizeof(Value));
}

}  // namespace

ReplayStorage::ReplayStorage(const ObservationSize& observation, std::size_t most_rows)
    : observation_(observation),
      // The rows may start in the middle of a chunk and end in the middle of another one.
      chunks_((most_rows + kChunkRows - 1) / kChunkRows + 1) {}

std::size_t ReplayStorage::bytes() const {
  std::size_t count = spare_.size();
  for (const auto& chunk : chunks_) count += chunk != nullptr ? 1 : 0;
  const std::size_t row = sizeof(TransitionFacts) + observation_.features * sizeof(float) +
                          observation_.tokens + observation_.actions;
  return count * kChunkRows * row;
}

std::unique_ptr<ReplayStorage::Chunk> ReplayStorage::new_chunk() {
  if (!spare_.empty()) {
    auto chunk = std::move(spare_.back());
    spare_.pop_back();
    return chunk;
  }
  auto chunk = std::make_unique<Chunk>();
  chunk->facts.resize(kChunkRows);
  // Not zeroed: every row is written before it is read, and untouched pages cost nothing.
  chunk->features.reset(new float[kChunkRows * observation_.features]);
  chunk->flags.reset(new std::uint8_t[kChunkRows * (observation_.tokens + observation_.actions)]);
  return chunk;
}

void ReplayStorage::store(std::uint64_t index, const Episode& episode, std::size_t row,
                          const TransitionFacts& facts) {
  auto& place = chunks_[index / kChunkRows % chunks_.size()];
  if (place == nullptr) place = new_chunk();
  const std::size_t to = index % kChunkRows;
  place->facts[to] = facts;
  const auto [features, tokens, actions] = observation_;
  const std::size_t width = tokens + actions;
  std::uint8_t* flags = &place->flags[to * width];
  if (features > 0) {
    std::memcpy(&place->features[to * features], &episode.features[row * features],
                features * sizeof(float));
  }
  if (tokens > 0) std::memcpy(flags, &episode.present[row * tokens], tokens);
  if (actions > 0) std::memcpy(flags + tokens, &episode.selectable[row * actions], actions);
}

void ReplayStorage::clear(std::uint64_t index) {
  for (auto& place : chunks_) {
    if (place != nullptr) spare_.push_back(std::move(place));
  }
  oldest_chunk_ = index / kChunkRows;
}

void ReplayStorage::forget_before(std::uint64_t index) {
  for (; oldest_chunk_ < index / kChunkRows; ++oldest_chunk_) {
    auto& place = chunks_[oldest_chunk_ % chunks_.size()];
    if (place != nullptr) spare_.push_back(std::move(place));
  }
}

void ReplayStorage::gather(std::size_t i, ReplayBatch& batch) const {
  const std::uint64_t index = batch.index[i];
  const TransitionFacts& of = facts(index);
  const std::uint64_t next = index + of.next;
  batch.action[i] = of.action;
  batch.returns[i] = of.returns;
  batch.to_end[i] = of.to_end;
  batch.discount[i] = of.discount;
  copy_row(features(index), observation_.features, batch.features, i);
  copy_row(flags(index), observation_.tokens, batch.present, i);
  copy_row(features(next), observation_.features, batch.next_features, i);
  copy_row(flags(next), observation_.tokens, batch.next_present, i);
  copy_row(flags(next) + observation_.tokens, observation_.actions, batch.next_selectable, i);
}

void ReplayStorage::prefetch(std::uint64_t index) const {
  __builtin_prefetch(&facts(index));
  __builtin_prefetch(features(index));
  __builtin_prefetch(flags(index));
}

}  // namespace linewright
