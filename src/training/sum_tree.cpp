#include "linewright/training/sum_tree.hpp"

#include <algorithm>
#include <array>

namespace linewright {
namespace {

constexpr std::size_t kChildren = 16;

/// Sum of a row of weights. Four chains, so that the additions do not wait for one another.
double sum_of(const float* row) {
  std::array<double, 4> part{};
  for (std::size_t i = 0; i < kChildren; i += 4) {
    for (std::size_t j = 0; j < 4; ++j) part[j] += static_cast<double>(row[i + j]);
  }
  return (part[0] + part[1]) + (part[2] + part[3]);
}

/// The child of a row of running sums that `prefix` falls into; takes off what stands before it.
std::size_t child_at(const double* row, double& prefix) {
  std::size_t child = 0;
  for (std::size_t i = 0; i < kChildren; ++i) child += row[i] <= prefix ? 1 : 0;
  if (child == kChildren) {  // rounding, or a prefix beyond the total: the last one with a weight
    child = 0;
    for (std::size_t i = 0; i < kChildren; ++i) child += row[i] < row[kChildren - 1] ? 1 : 0;
  }
  if (child > 0) prefix -= row[child - 1];
  return child;
}

/// The same in a row of weights.
std::size_t weight_at(const float* row, double prefix) {
  double sum = 0.0;
  std::size_t child = 0;
  for (std::size_t i = 0; i < kChildren; ++i) {
    sum += static_cast<double>(row[i]);
    child += sum <= prefix ? 1 : 0;
  }
  if (child < kChildren) return child;
  child = kChildren - 1;
  while (child > 0 && !(row[child] > 0.0F)) --child;
  return child;
}

}  // namespace

SumTree::SumTree(std::size_t leaves) : leaves_(leaves) {
  const auto rows_for = [](std::size_t count) {
    return std::max<std::size_t>(1, (count + kWidth - 1) / kWidth);
  };
  std::size_t rows = rows_for(leaves);
  weights_.assign(rows * kWidth, 0.0F);
  do {
    const std::size_t children = rows;
    rows = rows_for(children);
    levels_.emplace_back(rows * kWidth, 0.0);
  } while (rows > 1);
  marked_.assign(levels_.front().size(), 0);
}

/// Computes the running sums of one row of a level from the level below.
void SumTree::update_row(std::size_t level, std::size_t row) {
  double* sums = &levels_[level][row * kWidth];
  const std::size_t first = row * kWidth;
  // The last row may have fewer children than places: those behind the last child repeat its sum.
  const std::size_t below =
      level == 0 ? weights_.size() / kWidth : levels_[level - 1].size() / kWidth;
  const std::size_t children = std::min(kWidth, below - first);
  double sum = 0.0;
  for (std::size_t i = 0; i < children; ++i) {
    const std::size_t child = first + i;
    sum += level == 0 ? sum_of(&weights_[child * kWidth])
                      : levels_[level - 1][child * kWidth + kWidth - 1];
    sums[i] = sum;
  }
  for (std::size_t i = children; i < kWidth; ++i) sums[i] = sum;
}

void SumTree::set(std::size_t leaf, float weight) {
  weights_[leaf] = weight;
  std::size_t row = leaf >> kShift;
  for (std::size_t level = 0; level < levels_.size(); ++level) {
    row >>= kShift;
    update_row(level, row);
  }
}

/// `rows` are rows of what lies below `level`, in any order, each once.
void SumTree::update_above(std::size_t level, std::vector<std::size_t>& rows) {
  for (; level < levels_.size(); ++level) {
    next_rows_.clear();
    for (const std::size_t row : rows) {
      const std::size_t parent = row >> kShift;
      if (marked_[parent] != 0) continue;
      marked_[parent] = 1;
      next_rows_.push_back(parent);
    }
    for (const std::size_t row : next_rows_) {
      marked_[row] = 0;
      update_row(level, row);
    }
    std::swap(rows, next_rows_);
  }
}

void SumTree::set(std::span<const std::size_t> leaves, std::span<const float> weights) {
  rows_.clear();
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    weights_[leaves[i]] = weights[i];
    rows_.push_back(leaves[i] >> kShift);
  }
  update_above(0, rows_);
}

void SumTree::set_range(std::size_t first, std::span<const float> weights) {
  if (weights.empty()) return;
  std::copy(weights.begin(), weights.end(), weights_.begin() + static_cast<std::ptrdiff_t>(first));
  rows_.clear();
  const std::size_t last = first + weights.size() - 1;
  for (std::size_t row = first >> kShift; row <= last >> kShift; ++row) rows_.push_back(row);
  update_above(0, rows_);
}

std::size_t SumTree::find(double prefix) const {
  std::size_t row = 0;
  for (std::size_t level = levels_.size(); level-- > 0;) {
    row = row * kWidth + child_at(&levels_[level][row * kWidth], prefix);
  }
  return row * kWidth + weight_at(&weights_[row * kWidth], prefix);
}

}  // namespace linewright
