#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "linewright/map/footprint.hpp"
#include "linewright/map/occupancy_grid.hpp"

namespace linewright {

/// A grid prepared for collision checks: a bit per cell, and the distance field. Immutable; shared
/// by all checkers of all kinds of workers.
class ClearanceMap {
 public:
  explicit ClearanceMap(const OccupancyGrid& grid);

  [[nodiscard]] const GridFrame& frame() const { return frame_; }
  [[nodiscard]] bool blocked(Cell cell) const {
    return !frame_.contains(cell) || bits(cell.column, cell.row, 1) != 0;
  }
  /// In cells, between the middles of this cell and of the nearest blocked one.
  [[nodiscard]] float distance_cells(Cell cell) const { return distance_[frame_.index(cell)]; }
  [[nodiscard]] float distance_cells(std::size_t index) const { return distance_[index]; }

  /// Whether one of the columns first ... last of the row is blocked; outside all are.
  [[nodiscard]] bool any_blocked(std::int32_t first, std::int32_t last, std::int32_t row) const;

  /// `count` <= 64 cells of a row from `column` on, lowest bit first, 1 = blocked. They may lie up
  /// to 64 columns outside of the grid; rows outside are all blocked.
  [[nodiscard]] std::uint64_t bits(std::int32_t column, std::int32_t row, int count) const {
    const std::uint64_t mask = ~std::uint64_t{0} >> (64 - count);
    if (row < 0 || row >= frame_.rows) return mask;
    const auto bit = static_cast<std::size_t>(column + kMargin);
    const std::uint64_t* words = &bits_[static_cast<std::size_t>(row) * words_per_row_ + bit / 64];
    const std::size_t shift = bit % 64;
    std::uint64_t value = words[0] >> shift;
    if (shift != 0) value |= words[1] << (64 - shift);
    return value & mask;
  }

 private:
  static constexpr std::int32_t kMargin = 64;  ///< blocked columns on either side of each row

  GridFrame frame_;
  std::size_t words_per_row_;
  std::vector<std::uint64_t> bits_;
  std::vector<float> distance_;
};

/// Answers whether a footprint at a pose covers a part of a blocked cell. Exact; constant time
/// where the distance field decides, else a few cell rows are looked at. Poses are in the frame of
/// the grid (GridFrame::to_grid), metres and radians. Thread-safe.
class CollisionChecker {
 public:
  CollisionChecker(std::shared_ptr<const ClearanceMap> map, Footprint footprint);

  [[nodiscard]] bool free(const Pose2& in_grid) const;
  [[nodiscard]] const Footprint& footprint() const { return footprint_; }
  [[nodiscard]] const ClearanceMap& map() const { return *map_; }
  [[nodiscard]] std::shared_ptr<const ClearanceMap> shared_map() const { return map_; }

  /// What the distance field alone says about any pose whose point lies in the cell.
  enum class Verdict : std::uint8_t { kFree, kBlocked, kUndecided };
  [[nodiscard]] Verdict verdict(Cell cell) const {
    const float distance = map_->distance_cells(cell);
    if (distance >= free_from_) return Verdict::kFree;
    return distance <= blocked_to_ ? Verdict::kBlocked : Verdict::kUndecided;
  }
  /// The same without looking at the distance field: for tests and undecided poses.
  [[nodiscard]] bool free_exactly(const Pose2& in_grid) const;

 private:
  [[nodiscard]] bool disc_free(double x, double y) const;
  [[nodiscard]] bool convex_free(const Pose2& pose) const;
  [[nodiscard]] bool polygon_free(const Pose2& pose) const;

  std::shared_ptr<const ClearanceMap> map_;
  Footprint footprint_;
  float free_from_;   ///< cells
  float blocked_to_;  ///< cells
};

}  // namespace linewright
