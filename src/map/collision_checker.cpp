#include "linewright/map/collision_checker.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "linewright/map/distance_field.hpp"
#include "linewright/map/row_spans.hpp"

namespace linewright {
namespace {

/// Half the diagonal of a cell, in cells, and a little more for the rounding of floats.
constexpr double kHalfDiagonal = 0.70711;
constexpr double kSlack = 1e-9;
constexpr std::size_t kMostQuickCorners = 16;

struct Quick {
  std::array<double, kMostQuickCorners> x;
  std::array<double, kMostQuickCorners> y;
};

}  // namespace

ClearanceMap::ClearanceMap(const OccupancyGrid& grid)
    : frame_(grid.frame()),
      // One word more, so that reading across a word's edge needs no check.
      words_per_row_((static_cast<std::size_t>(frame_.columns) + 2 * kMargin + 63) / 64 + 1),
      bits_(words_per_row_ * static_cast<std::size_t>(frame_.rows), ~std::uint64_t{0}),
      distance_(distance_field(grid)) {
  for (std::int32_t row = 0; row < frame_.rows; ++row) {
    std::uint64_t* words = &bits_[static_cast<std::size_t>(row) * words_per_row_];
    for (std::int32_t column = 0; column < frame_.columns; ++column) {
      if (grid.state({column, row}) != CellState::kFree) continue;
      const auto bit = static_cast<std::size_t>(column + kMargin);
      words[bit / 64] &= ~(std::uint64_t{1} << (bit % 64));
    }
  }
}

bool ClearanceMap::any_blocked(std::int32_t first, std::int32_t last, std::int32_t row) const {
  if (first < 0 || last >= frame_.columns) return true;
  while (last - first >= 64) {
    if (bits(first, row, 64) != 0) return true;
    first += 64;
  }
  return bits(first, row, last - first + 1) != 0;
}

CollisionChecker::CollisionChecker(std::shared_ptr<const ClearanceMap> map, Footprint footprint)
    : map_(std::move(map)),
      footprint_(std::move(footprint)),
      // The pose lies up to half a diagonal from its cell's middle, and the corner of a blocked
      // cell as far from that one's.
      free_from_(static_cast<float>(footprint_.circumscribed_m() / map_->frame().cell_m +
                                    2 * kHalfDiagonal)),
      blocked_to_(static_cast<float>(footprint_.inscribed_m() / map_->frame().cell_m -
                                     kHalfDiagonal - 1e-4)) {
  const bool covers_its_pose = footprint_.is_circle() || contains(footprint_.corners(), {});
  // What covers the point of its pose covers the cell around that point.
  blocked_to_ = covers_its_pose ? std::max(blocked_to_, 0.0F) : -1.0F;
}

bool CollisionChecker::free(const Pose2& pose) const {
  const double cell_m = map_->frame().cell_m;
  const double column = pose.x_m / cell_m;
  const double row = pose.y_m / cell_m;
  if (column >= 0.0 && row >= 0.0 && column < map_->frame().columns && row < map_->frame().rows) {
    const Verdict known =
        verdict({static_cast<std::int32_t>(column), static_cast<std::int32_t>(row)});
    if (known != Verdict::kUndecided) return known == Verdict::kFree;
  }
  return free_exactly(pose);
}

bool CollisionChecker::free_exactly(const Pose2& pose) const {
  if (footprint_.is_circle()) return disc_free(pose.x_m, pose.y_m);
  if (footprint_.is_convex() && footprint_.corners().size() <= kMostQuickCorners) {
    return convex_free(pose);
  }
  return polygon_free(pose);
}

bool CollisionChecker::disc_free(double x_m, double y_m) const {
  const double cell_m = map_->frame().cell_m;
  const double x = x_m / cell_m;
  const double y = y_m / cell_m;
  const double radius = footprint_.circumscribed_m() / cell_m;
  const ColumnSpan rows = columns_between(y - radius, y + radius);
  for (std::int32_t row = rows.first; row <= rows.last; ++row) {
    // From the disc's middle to the nearest line of the row.
    const double away = std::max({row - y, 0.0, y - row - 1.0});
    const double half = std::sqrt(std::max(0.0, radius * radius - away * away));
    const ColumnSpan span = columns_between(x - half, x + half);
    if (span.first <= span.last && map_->any_blocked(span.first, span.last, row)) return false;
  }
  // A point covers the cell that it is in.
  return radius > 0.0 || !map_->blocked({static_cast<std::int32_t>(std::floor(x)),
                                         static_cast<std::int32_t>(std::floor(y))});
}

bool CollisionChecker::convex_free(const Pose2& pose) const {
  const Polygon& corners = footprint_.corners();
  const std::size_t count = corners.size();
  const double scale = 1.0 / map_->frame().cell_m;
  const double c = std::cos(pose.heading_rad);
  const double s = std::sin(pose.heading_rad);
  Quick at;
  double low = 1e300;
  double high = -1e300;
  for (std::size_t i = 0; i < count; ++i) {
    at.x[i] = (pose.x_m + c * corners[i].x_m - s * corners[i].y_m) * scale;
    at.y[i] = (pose.y_m + s * corners[i].x_m + c * corners[i].y_m) * scale;
    low = std::min(low, at.y[i]);
    high = std::max(high, at.y[i]);
  }
  const ColumnSpan rows = columns_between(low, high);
  for (std::int32_t row = rows.first; row <= rows.last; ++row) {
    const double bottom = row + kSlack;
    const double top = row + 1.0 - kSlack;
    double left = 1e300;
    double right = -1e300;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t j = i + 1 < count ? i + 1 : 0;
      const std::size_t a = at.y[i] <= at.y[j] ? i : j;
      const std::size_t b = a == i ? j : i;
      if (at.y[a] > top || at.y[b] < bottom) continue;
      const double rise = at.y[b] - at.y[a];
      const double slope = rise > 0.0 ? (at.x[b] - at.x[a]) / rise : 0.0;
      const double x0 = at.y[a] >= bottom ? at.x[a] : at.x[a] + slope * (bottom - at.y[a]);
      const double x1 = at.y[b] <= top ? at.x[b] : at.x[a] + slope * (top - at.y[a]);
      left = std::min({left, x0, x1});
      right = std::max({right, x0, x1});
    }
    const ColumnSpan span = columns_between(left, right);
    if (span.first <= span.last && map_->any_blocked(span.first, span.last, row)) return false;
  }
  return true;
}

bool CollisionChecker::polygon_free(const Pose2& pose) const {
  Polygon in_cells = footprint_.at(pose);
  for (Point2& corner : in_cells) {
    corner.x_m /= map_->frame().cell_m;
    corner.y_m /= map_->frame().cell_m;
  }
  RowSpans spans(in_cells, footprint_.is_convex());
  for (std::int32_t row = spans.first_row(); row <= spans.last_row(); ++row) {
    const bool hit = spans.any_in_row(
        row, [&](ColumnSpan span) { return map_->any_blocked(span.first, span.last, row); });
    if (hit) return false;
  }
  return true;
}

}  // namespace linewright
