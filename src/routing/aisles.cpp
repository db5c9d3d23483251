#include "aisles.hpp"

#include <algorithm>
#include <cmath>

#include "linewright/map/row_spans.hpp"

namespace linewright {
namespace {

constexpr double kHalfDiagonal = 0.70711;
/// Discs wider than that are measured by the distance field alone: the shape of single cells
/// matters little to them, and they cover many.
constexpr double kSmall_cells = 4.0;
/// Points looked at in a cell, in each direction.
constexpr int kPoints = 4;

/// The cells of one row that a disc around a point of cell (0, 0) covers a part of.
struct Covered {
  std::int32_t row;
  ColumnSpan columns;
};

std::vector<Covered> covered_by(double x, double y, double radius) {
  std::vector<Covered> covered;
  const ColumnSpan rows = columns_between(y - radius, y + radius);
  for (std::int32_t row = rows.first; row <= rows.last; ++row) {
    const double away = std::max({row - y, 0.0, y - row - 1.0});
    const double half = std::sqrt(std::max(0.0, radius * radius - away * away));
    covered.push_back({row, columns_between(x - half, x + half)});
  }
  return covered;
}

/// Looks at 64 cells of a row at once.
class SmallDisc {
 public:
  SmallDisc(const ClearanceMap& map, double radius_cells)
      : map_(map), reach_(static_cast<std::int32_t>(std::ceil(radius_cells)) + 1) {
    // Every point of the cell is so close to one of those looked at.
    const double radius = std::max(0.0, radius_cells - kHalfDiagonal / kPoints - 1e-6);
    for (int i = 0; i < kPoints * kPoints; ++i) {
      points_.push_back(
          covered_by((i % kPoints + 0.5) / kPoints, (i / kPoints + 0.5) / kPoints, radius));
    }
  }

  [[nodiscard]] std::uint64_t passable(std::int32_t column, std::int32_t row) const {
    const std::uint64_t blocked = map_.bits(column, row, 64);
    if (blocked == ~std::uint64_t{0}) return 0;
    if (blocked == 0 && empty_around(column, row)) return ~std::uint64_t{0};
    std::uint64_t everywhere = ~std::uint64_t{0};
    for (const std::vector<Covered>& point : points_) {
      everywhere &= hit(point, column, row) | blocked;
      if (everywhere == blocked) break;
    }
    return ~everywhere;
  }

 private:
  [[nodiscard]] bool empty_around(std::int32_t column, std::int32_t row) const {
    for (std::int32_t r = row - reach_; r <= row + reach_; ++r) {
      if ((map_.bits(column - reach_, r, 64) | map_.bits(column + reach_, r, 64)) != 0) {
        return false;
      }
    }
    return true;
  }

  [[nodiscard]] std::uint64_t hit(const std::vector<Covered>& point, std::int32_t column,
                                  std::int32_t row) const {
    std::uint64_t any = 0;
    for (const Covered& covered : point) {
      for (std::int32_t c = covered.columns.first; c <= covered.columns.last; ++c) {
        any |= map_.bits(column + c, row + covered.row, 64);
      }
    }
    return any;
  }

  const ClearanceMap& map_;
  std::int32_t reach_;
  std::vector<std::vector<Covered>> points_;
};

}  // namespace

std::vector<std::uint64_t> passable_cells(const ClearanceMap& map, double radius_m) {
  const GridFrame& frame = map.frame();
  std::vector<std::uint64_t> passable(frame.size() / 64 + 2, 0);
  const double radius_cells = radius_m / frame.cell_m;
  if (radius_cells > kSmall_cells) {
    const auto least = static_cast<float>(radius_cells - kHalfDiagonal - 1e-4);
    for (std::size_t i = 0; i < frame.size(); ++i) {
      passable[i / 64] |= static_cast<std::uint64_t>(map.distance_cells(i) > least) << (i % 64);
    }
    return passable;
  }
  const SmallDisc disc(map, radius_cells);
  for (std::int32_t row = 0; row < frame.rows; ++row) {
    for (std::int32_t column = 0; column < frame.columns; column += 64) {
      const std::int32_t count = std::min(64, frame.columns - column);
      const std::uint64_t bits = disc.passable(column, row) & (~std::uint64_t{0} >> (64 - count));
      const std::size_t first = frame.index({column, row});
      passable[first / 64] |= bits << (first % 64);
      if (first % 64 != 0) passable[first / 64 + 1] |= bits >> (64 - first % 64);
    }
  }
  return passable;
}

}  // namespace linewright
