#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace linewright {

/// Weights of many items and their running sums: draws an item with a probability proportional to
/// its weight, in four comparisons per level. Nodes have 16 children. Every inner number is always
/// computed anew from the weights below it, in fixed order: the tree is a function of its weights
/// alone, so nothing drifts, and setting the same weights again restores it bit for bit.
class SumTree {
 public:
  /// `leaves` items of weight 0; 5.1 bytes each.
  explicit SumTree(std::size_t leaves);

  [[nodiscard]] std::size_t size() const { return leaves_; }
  [[nodiscard]] float operator[](std::size_t leaf) const { return weights_[leaf]; }
  /// The sum of all weights.
  [[nodiscard]] double total() const { return sums_.back().front(); }

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
  /// The same for many prefixes, which are used up; faster, since the searches do not wait for one
  /// another's memory. Both spans have the same size.
  void find(std::span<double> prefixes, std::span<std::size_t> leaves) const;

 private:
  void update_row(std::size_t level, std::size_t row);
  void update_above();
  [[nodiscard]] std::size_t with_weight(std::size_t leaf) const;

  std::size_t leaves_;
  std::vector<float> weights_;  ///< padded with zeros to whole rows of 16
  /// [0]: the sum of each row of weights; [l + 1]: the sum of each row of [l]. The last is one sum.
  std::vector<std::vector<double>> sums_;
  /// The same, but without the last, in whole rows of 16: the sum of those before it in its row.
  std::vector<std::vector<double>> before_;
  std::vector<std::uint8_t> marked_;  ///< by row, while a batch is set
  std::vector<std::size_t> rows_;     ///< of a batch, one level after the other
  std::vector<std::size_t> next_rows_;
};

}  // namespace linewright
