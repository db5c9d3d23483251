#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace linewright {

/// Weights of many items and their running sums: draws an item with a probability proportional to
/// its weight, in a few comparisons per level. Nodes have 16 children. Every inner number is always
/// computed anew from the weights below it, in fixed order: the tree is a function of its weights
/// alone, so nothing drifts, and setting the same weights again restores it bit for bit.
class SumTree {
 public:
  /// `leaves` items of weight 0; 4.6 bytes each.
  explicit SumTree(std::size_t leaves);

  [[nodiscard]] std::size_t size() const { return leaves_; }
  [[nodiscard]] float operator[](std::size_t leaf) const { return weights_[leaf]; }
  /// The sum of all weights.
  [[nodiscard]] double total() const { return levels_.back().back(); }

  /// `weight` >= 0 and finite.
  void set(std::size_t leaf, float weight);
  /// Sets many weights and computes every node above them once. The last one wins where a leaf is
  /// named twice. Both spans have the same size.
  void set(std::span<const std::size_t> leaves, std::span<const float> weights);
  /// Sets the leaves `first`, `first` + 1, ...
  void set_range(std::size_t first, std::span<const float> weights);

  /// The leaf at which the running sum of the weights first exceeds `prefix`, for 0 <= `prefix` <
  /// total(). Up to rounding: a leaf of weight 0 is never returned while total() > 0, and a prefix
  /// beyond the total gives the last leaf that has a weight.
  [[nodiscard]] std::size_t find(double prefix) const;

 private:
  static constexpr std::size_t kWidth = 16;
  static constexpr std::size_t kShift = 4;

  void update_row(std::size_t level, std::size_t row);
  void update_above(std::size_t level, std::vector<std::size_t>& rows);

  std::size_t leaves_;
  std::vector<float> weights_;  ///< padded with zeros to whole rows of 16
  /// [level][child]: the sum of this child and those before it in its row of 16. The children of
  /// level 0 are rows of weights, those of level 1 rows of level 0, ...; the last level is one row.
  std::vector<std::vector<double>> levels_;
  std::vector<std::uint8_t> marked_;    ///< by row, while a batch is set
  std::vector<std::size_t> rows_;       ///< of a batch
  std::vector<std::size_t> next_rows_;  ///< one level up
};

}  // namespace linewright
