#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "linewright/map/occupancy_grid.hpp"

namespace linewright {

/// The nodes of a search over cells and headings, in one block of all headings per cell, made when
/// a cell is first reached: memory and clearing follow what was searched, not the size of the map.
class NodeStore {
 public:
  static constexpr std::uint32_t kNoParent = ~std::uint32_t{0};
  static constexpr int kMoveBits = 5;
  static constexpr std::uint32_t kMostNodes = std::uint32_t{1} << (32 - kMoveBits);

  /// Cost of a node that has been expanded: below every other, so that nothing replaces a node
  /// whose children start at its pose.
  static constexpr float kExpanded = -1.0F;

  struct Node {
    float cost_m = std::numeric_limits<float>::infinity();
    float x_m = 0.0F;
    float y_m = 0.0F;
    std::uint32_t from = kNoParent;  ///< parent << kMoveBits | move

    [[nodiscard]] bool is_root() const { return from == kNoParent; }
    [[nodiscard]] std::uint32_t parent() const { return from >> kMoveBits; }
    [[nodiscard]] std::uint32_t move() const { return from & ((1U << kMoveBits) - 1); }
  };

  NodeStore(std::size_t cells, int headings)
      : headings_(static_cast<std::uint32_t>(headings)), block_of_(cells, kNone) {}

  void clear() {
    for (const std::uint32_t cell : cells_) block_of_[cell] = kNone;
    cells_.clear();
    nodes_.clear();
  }

  /// Number of the node; its block is made when missing. References to nodes may become invalid.
  [[nodiscard]] std::uint32_t id(std::size_t cell, int heading) {
    if (block_of_[cell] == kNone) make_block(cell);
    return block_of_[cell] * headings_ + static_cast<std::uint32_t>(heading);
  }
  [[nodiscard]] Node& operator[](std::uint32_t id) { return nodes_[id]; }
  [[nodiscard]] const Node& operator[](std::uint32_t id) const { return nodes_[id]; }
  [[nodiscard]] int heading(std::uint32_t id) const { return static_cast<int>(id % headings_); }
  [[nodiscard]] bool full() const { return nodes_.size() + headings_ > kMostNodes; }

 private:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  void make_block(std::size_t cell) {
    block_of_[cell] = static_cast<std::uint32_t>(cells_.size());
    cells_.push_back(static_cast<std::uint32_t>(cell));
    nodes_.resize(nodes_.size() + headings_);
  }

  std::uint32_t headings_;
  std::vector<std::uint32_t> block_of_;  ///< by cell
  std::vector<std::uint32_t> cells_;     ///< by block
  std::vector<Node> nodes_;
};

/// Open nodes in buckets of nearly equal priority; within one, the last one in is the first one
/// out, so that a search goes deep among equals.
class BucketQueue {
 public:
  struct Entry {
    std::uint32_t node;
    float cost_m;  ///< of the node when it was pushed
  };

  explicit BucketQueue(double width_m) : scale_(static_cast<float>(1.0 / width_m)) {}

  void clear() {
    for (std::size_t i = 0; i < used_; ++i) buckets_[i].clear();
    used_ = lowest_ = size_ = 0;
  }
  [[nodiscard]] bool empty() const { return size_ == 0; }

  void push(float priority_m, Entry entry) {
    // What is dearer than the last bucket shares it: far beyond any hall, the order matters less
    // than the memory.
    const auto bucket = static_cast<std::size_t>(std::min(priority_m * scale_, kLastBucket));
    if (bucket >= buckets_.size()) buckets_.resize(bucket + bucket / 2 + 64);
    used_ = bucket >= used_ ? bucket + 1 : used_;
    lowest_ = bucket < lowest_ || size_ == 0 ? bucket : lowest_;
    buckets_[bucket].push_back(entry);
    ++size_;
  }

  /// Nothing that is left has a smaller priority. Not for an empty queue.
  [[nodiscard]] float lowest_m() {
    while (buckets_[lowest_].empty()) ++lowest_;
    return static_cast<float>(lowest_) / scale_;
  }

  [[nodiscard]] Entry pop() {
    while (buckets_[lowest_].empty()) ++lowest_;
    const Entry entry = buckets_[lowest_].back();
    buckets_[lowest_].pop_back();
    --size_;
    return entry;
  }

 private:
  static constexpr float kLastBucket = 1'000'000.0F;

  float scale_;
  std::vector<std::vector<Entry>> buckets_;
  std::size_t used_ = 0;
  std::size_t lowest_ = 0;
  std::size_t size_ = 0;
};

}  // namespace linewright
