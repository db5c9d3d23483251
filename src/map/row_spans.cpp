#include "linewright/map/row_spans.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace linewright {
namespace {

/// Cells that are covered by less than this (in cells) are only touched.
constexpr double kSlack = 1e-9;

/// Rows and columns are int32; what lies beyond is outside of every grid anyway.
std::int32_t to_index(double cells) {
  constexpr double kLimit = 1e9;
  return static_cast<std::int32_t>(std::clamp(cells, -kLimit, kLimit));
}

struct Interval {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  [[nodiscard]] bool empty() const { return low > high; }
};

/// The x of the part of the side a-b whose y is in [bottom, top].
Interval clipped(Point2 a, Point2 b, double bottom, double top) {
  Interval x;
  if (a.y_m > b.y_m) std::swap(a, b);
  if (a.y_m > top || b.y_m < bottom) return x;
  const double rise = b.y_m - a.y_m;
  const auto at = [&](double y) {
    return rise > 0.0 ? a.x_m + (b.x_m - a.x_m) * ((y - a.y_m) / rise) : a.x_m;
  };
  x.add(a.y_m >= bottom ? a.x_m : at(bottom));
  x.add(b.y_m <= top ? b.x_m : at(top));
  return x;
}

}  // namespace

ColumnSpan columns_between(double low, double high) {
  return {to_index(std::floor(low + kSlack)), to_index(std::ceil(high - kSlack) - 1.0)};
}

RowSpans::RowSpans(const Polygon& polygon, bool convex) : polygon_(polygon), convex_(convex) {
  const Rectangle bounds = bounds_of(polygon);
  const ColumnSpan rows = columns_between(bounds.y0_m, bounds.y1_m);
  first_row_ = rows.first;
  last_row_ = rows.last;
}

void RowSpans::collect(std::int32_t row) {
  const double bottom = row + kSlack;
  const double top = row + 1.0 - kSlack;
  spans_.clear();
  Interval all;
  for (std::size_t i = 0; i < polygon_.size(); ++i) {
    const Interval x =
        clipped(polygon_[i], polygon_[i + 1 < polygon_.size() ? i + 1 : 0], bottom, top);
    if (x.empty()) continue;
    if (convex_) {
      all.add(x.low);
      all.add(x.high);
    } else {
      spans_.push_back(columns_between(x.low, x.high));
    }
  }
  if (!convex_) {
    collect_inside(row + 0.5);
  } else if (!all.empty()) {
    spans_.push_back(columns_between(all.low, all.high));
  }
}

void RowSpans::collect_inside(double middle) {
  crossings_.clear();
  for (std::size_t i = 0; i < polygon_.size(); ++i) {
    const Point2 a = polygon_[i];
    const Point2 b = polygon_[i + 1 < polygon_.size() ? i + 1 : 0];
    if ((a.y_m > middle) == (b.y_m > middle)) continue;
    crossings_.push_back(a.x_m + (b.x_m - a.x_m) * ((middle - a.y_m) / (b.y_m - a.y_m)));
  }
  std::sort(crossings_.begin(), crossings_.end());
  for (std::size_t i = 0; i + 1 < crossings_.size(); i += 2) {
    // Cells whose middle lies between the crossings.
    spans_.push_back(
        {to_index(std::ceil(crossings_[i] - 0.5)), to_index(std::floor(crossings_[i + 1] - 0.5))});
  }
}

}  // namespace linewright
