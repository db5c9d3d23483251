#include "linewright/map/distance_field.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace linewright {
namespace {

/// Per cell the distance to the nearest blocked cell of its column, the edge included.
std::vector<std::int32_t> column_distances(const OccupancyGrid& grid) {
  const std::int32_t columns = grid.columns();
  const std::int32_t rows = grid.rows();
  std::vector<std::int32_t> distance(grid.size());
  const auto at = [&](std::int32_t column, std::int32_t row) -> std::int32_t& {
    return distance[grid.frame().index({column, row})];
  };
  // Row by row in both passes, so that memory is read in order.
  for (std::int32_t row = 0; row < rows; ++row) {
    for (std::int32_t column = 0; column < columns; ++column) {
      const bool blocked = grid.state({column, row}) != CellState::kFree;
      at(column, row) = blocked ? 0 : (row == 0 ? 1 : at(column, row - 1) + 1);
    }
  }
  for (std::int32_t row = rows; row-- > 0;) {
    for (std::int32_t column = 0; column < columns; ++column) {
      const std::int32_t below = row + 1 == rows ? 1 : at(column, row + 1) + 1;
      at(column, row) = std::min(at(column, row), below);
    }
  }
  return distance;
}

/// The lower envelope of one row's parabolas (x - i)^2 + g(i)^2.
class RowEnvelope {
 public:
  explicit RowEnvelope(std::int32_t columns) {
    apex_.resize(static_cast<std::size_t>(columns) + 2);
    from_.resize(apex_.size());
  }

  /// `g` has `columns` entries; the parabolas of the edge, at -1 and `columns` with height 0, are
  /// added.
  void run(const std::int32_t* g, std::int32_t columns, float* out) {
    g_ = g;
    columns_ = columns;
    std::size_t last = 0;
    apex_[0] = -1;
    from_[0] = 0;
    for (std::int32_t i = 0; i <= columns; ++i) {
      while (last > 0 && first_below(apex_[last], i) <= from_[last]) --last;
      const std::int64_t start = first_below(apex_[last], i);
      if (start <= from_[last]) {
        apex_[0] = i;  // lower than the first one from the very start on
      } else if (start < columns) {
        apex_[++last] = i;
        from_[last] = start;
      }
    }
    for (std::int32_t x = columns; x-- > 0;) {
      while (from_[last] > x) --last;
      out[x] = static_cast<float>(std::sqrt(static_cast<double>(value(apex_[last], x))));
    }
  }

 private:
  [[nodiscard]] std::int64_t height(std::int32_t i) const {
    return i < 0 || i >= columns_ ? 0 : std::int64_t{g_[i]} * g_[i];
  }
  [[nodiscard]] std::int64_t value(std::int32_t i, std::int64_t x) const {
    return (x - i) * (x - i) + height(i);
  }
  /// The first x at which parabola i is below parabola k < i, or equal to it.
  [[nodiscard]] std::int64_t first_below(std::int64_t k, std::int64_t i) const {
    const std::int64_t top =
        i * i - k * k + height(static_cast<std::int32_t>(i)) - height(static_cast<std::int32_t>(k));
    const std::int64_t bottom = 2 * (i - k);
    return top >= 0 ? (top + bottom - 1) / bottom : -(-top / bottom);
  }

  const std::int32_t* g_ = nullptr;
  std::int32_t columns_ = 0;
  std::vector<std::int32_t> apex_;  ///< columns of the parabolas on the envelope, ascending
  std::vector<std::int64_t> from_;  ///< by entry of apex_: the first column where it is lowest
};

}  // namespace

std::vector<float> distance_field(const OccupancyGrid& grid) {
  const std::vector<std::int32_t> columns = column_distances(grid);
  std::vector<float> field(grid.size());
  RowEnvelope envelope(grid.columns());
  const auto width = static_cast<std::size_t>(grid.columns());
  for (std::size_t first = 0; first < field.size(); first += width) {
    envelope.run(&columns[first], grid.columns(), &field[first]);
  }
  return field;
}

}  // namespace linewright
