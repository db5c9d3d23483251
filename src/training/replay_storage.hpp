#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "linewright/training/episode.hpp"
#include "linewright/training/replay_buffer.hpp"

namespace linewright {

/// What is known of one transition besides its observation.
struct TransitionFacts {
  float returns = 0.0F;
  float to_end = 0.0F;
  float discount = 0.0F;
  std::uint32_t copies = 1;
  std::uint16_t action = 0;
  std::uint16_t next = 0;  ///< rows from here to the next state; 0: the episode ended before
};

/// Rows of observations and facts under ever growing indices, in chunks that are taken when they
/// are needed and used again once all their rows were evicted.
class ReplayStorage {
 public:
  static constexpr std::size_t kChunkRows = 1024;

  /// At most `most_rows` rows will be there at a time.
  ReplayStorage(const ObservationSize& observation, std::size_t most_rows);

  [[nodiscard]] const ObservationSize& observation() const { return observation_; }
  /// Indices that are this far apart never stand there together.
  [[nodiscard]] std::size_t ring() const { return chunks_.size() * kChunkRows; }
  [[nodiscard]] std::size_t bytes() const;

  /// Stores row `row` of the episode under `index`, which is the last one's plus 1 (any, when
  /// nothing is stored).
  void store(std::uint64_t index, const Episode& episode, std::size_t row,
             const TransitionFacts& facts);
  /// Forgets all rows; the next one gets `index`.
  void clear(std::uint64_t index);
  /// `index` is the oldest row that is left (or the next one, when none is).
  void forget_before(std::uint64_t index);

  [[nodiscard]] const TransitionFacts& facts(std::uint64_t index) const {
    return chunk(index)->facts[index % kChunkRows];
  }
  /// Copies the row of `batch.index[i]` to row `i` of the batch's columns.
  void gather(std::size_t i, ReplayBatch& batch) const;
  /// Asks for the memory that gather() will read.
  void prefetch(std::uint64_t index) const;

 private:
  struct Chunk {
    std::vector<TransitionFacts> facts;
    std::unique_ptr<float[]> features;
    std::unique_ptr<std::uint8_t[]> flags;  ///< per row: present, then selectable
  };

  [[nodiscard]] const std::unique_ptr<Chunk>& chunk(std::uint64_t index) const {
    return chunks_[index / kChunkRows % chunks_.size()];
  }
  [[nodiscard]] std::unique_ptr<Chunk> new_chunk();
  [[nodiscard]] const float* features(std::uint64_t index) const {
    return &chunk(index)->features[index % kChunkRows * observation_.features];
  }
  [[nodiscard]] const std::uint8_t* flags(std::uint64_t index) const {
    return &chunk(index)->flags[index % kChunkRows * (observation_.tokens + observation_.actions)];
  }

  ObservationSize observation_;
  std::vector<std::unique_ptr<Chunk>> chunks_;  ///< a ring; null where nothing is stored
  std::vector<std::unique_ptr<Chunk>> spare_;
  std::uint64_t oldest_chunk_ = 0;  ///< number of the first chunk that holds rows
};

}  // namespace linewright
