#include "linewright/training/sum_tree.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace linewright {
namespace {

constexpr std::size_t kWidth = 16;

std::size_t rows_for(std::size_t count) {
  return std::max<std::size_t>(1, (count + kWidth - 1) / kWidth);
}

/// Sum of a row of weights. Four chains, so that the additions do not wait for one another.
double sum_of(const float* row) {
  std::array<double, 4> part{};
  for (std::size_t i = 0; i < kWidth; i += 4) {
    for (std::size_t j = 0; j < 4; ++j) part[j] += static_cast<double>(row[i + j]);
  }
  return (part[0] + part[1]) + (part[2] + part[3]);
}

/// The last of 16 ascending sums that is not beyond `prefix`, which it is then taken off. Without
/// branches: which child it is cannot be foreseen.
std::size_t child_at(const double* before, double& prefix) {
  std::size_t child = 0;
  child += before[child + 8] <= prefix ? 8 : 0;
  child += before[child + 4] <= prefix ? 4 : 0;
  child += before[child + 2] <= prefix ? 2 : 0;
  child += before[child + 1] <= prefix ? 1 : 0;
  prefix -= before[child];
  return child;
}

/// The weight of a row into which `prefix` falls: first the quarter, then the one of four.
std::size_t weight_at(const float* row, double prefix) {
  const auto weight = [&](std::size_t i) { return static_cast<double>(row[i]); };
  const auto quarter = [&](std::size_t i) {
    return (weight(i) + weight(i + 1)) + (weight(i + 2) + weight(i + 3));
  };
  const double first = quarter(0);
  const double second = first + quarter(4);
  const double third = second + quarter(8);
  const std::array<double, 4> before{0.0, first, second, third};
  const auto passed = [&](double sum) { return sum <= prefix ? std::size_t{1} : std::size_t{0}; };
  const std::size_t part = passed(first) + passed(second) + passed(third);
  prefix -= before[part];
  const double one = weight(4 * part);
  const double two = one + weight(4 * part + 1);
  const double three = two + weight(4 * part + 2);
  return 4 * part + passed(one) + passed(two) + passed(three);
}

}  // namespace

SumTree::SumTree(std::size_t leaves) : leaves_(leaves) {
  std::size_t count = rows_for(leaves);
  weights_.assign(count * kWidth, 0.0F);
  while (true) {
    const std::size_t rows = rows_for(count);
    sums_.emplace_back(count, 0.0);
    // The last row may have fewer children than places: those without one are never reached.
    before_.emplace_back(rows * kWidth, std::numeric_limits<double>::infinity());
    std::fill_n(before_.back().begin(), count, 0.0);
    count = rows;
    if (rows == 1) break;
  }
  sums_.emplace_back(1, 0.0);
  marked_.assign(sums_.front().size(), 0);
}

void SumTree::update_row(std::size_t level, std::size_t row) {
  const double* sums = &sums_[level][row * kWidth];
  double* before = &before_[level][row * kWidth];
  const std::size_t children = std::min(kWidth, sums_[level].size() - row * kWidth);
  double sum = 0.0;
  for (std::size_t i = 0; i < children; ++i) {
    before[i] = sum;
    sum += sums[i];
  }
  sums_[level + 1][row] = sum;
}

void SumTree::set(std::size_t leaf, float weight) {
  weights_[leaf] = weight;
  std::size_t row = leaf / kWidth;
  sums_[0][row] = sum_of(&weights_[row * kWidth]);
  for (std::size_t level = 0; level < before_.size(); ++level) {
    row /= kWidth;
    update_row(level, row);
  }
}

/// Computes everything above the rows of weights in `rows_`, each node once.
void SumTree::update_above() {
  for (const std::size_t row : rows_) sums_[0][row] = sum_of(&weights_[row * kWidth]);
  for (std::size_t level = 0; level < before_.size(); ++level) {
    next_rows_.clear();
    for (const std::size_t row : rows_) {
      const std::size_t parent = row / kWidth;
      if (marked_[parent] != 0) continue;
      marked_[parent] = 1;
      next_rows_.push_back(parent);
    }
    for (const std::size_t row : next_rows_) {
      marked_[row] = 0;
      update_row(level, row);
    }
    std::swap(rows_, next_rows_);
  }
}

void SumTree::set(std::span<const std::size_t> leaves, std::span<const float> weights) {
  rows_.clear();
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    weights_[leaves[i]] = weights[i];
    rows_.push_back(leaves[i] / kWidth);
  }
  update_above();
}

void SumTree::set_range(std::size_t first, std::span<const float> weights) {
  if (weights.empty()) return;
  std::copy(weights.begin(), weights.end(), weights_.begin() + static_cast<std::ptrdiff_t>(first));
  rows_.clear();
  const std::size_t last = first + weights.size() - 1;
  for (std::size_t row = first / kWidth; row <= last / kWidth; ++row) rows_.push_back(row);
  update_above();
}

/// `leaf`, or where rounding led to one without weight the nearest before it (else behind it).
std::size_t SumTree::with_weight(std::size_t leaf) const {
  if (weights_[leaf] > 0.0F) return leaf;
  for (std::size_t i = leaf; i-- > 0;) {
    if (weights_[i] > 0.0F) return i;
  }
  const auto next = std::find_if(weights_.begin() + static_cast<std::ptrdiff_t>(leaf),
                                 weights_.end(), [](float weight) { return weight > 0.0F; });
  return next == weights_.end() ? 0 : static_cast<std::size_t>(next - weights_.begin());
}

std::size_t SumTree::find(double prefix) const {
  std::size_t row = 0;
  for (std::size_t level = before_.size(); level-- > 0;) {
    row = row * kWidth + child_at(&before_[level][row * kWidth], prefix);
  }
  return with_weight(row * kWidth + weight_at(&weights_[row * kWidth], prefix));
}

void SumTree::find(std::span<double> prefixes, std::span<std::size_t> leaves) const {
  std::fill(leaves.begin(), leaves.end(), 0);
  for (std::size_t level = before_.size(); level-- > 0;) {
    const double* before = before_[level].data();
    for (std::size_t i = 0; i < leaves.size(); ++i) {
      leaves[i] = leaves[i] * kWidth + child_at(before + leaves[i] * kWidth, prefixes[i]);
      if (level > 0) {
        __builtin_prefetch(&before_[level - 1][leaves[i] * kWidth]);
      } else {
        __builtin_prefetch(&weights_[leaves[i] * kWidth]);
      }
    }
  }
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    const std::size_t first = leaves[i] * kWidth;
    leaves[i] = with_weight(first + weight_at(&weights_[first], prefixes[i]));
  }
}

}  // namespace linewright
