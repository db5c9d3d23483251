#pragma once

#include <cstdint>
#include <vector>

#include "linewright/map/polygon.hpp"

namespace linewright {

/// Columns first ... last, both included.
struct ColumnSpan {
  std::int32_t first = 0;
  std::int32_t last = -1;
};

/// The rows, and in each of them the spans of columns, whose cells an area covers a part of. All
/// coordinates in cells: cell (c, r) is the square [c, c + 1] x [r, r + 1]. Touching is not
/// covering. A cell is covered when a side of the polygon passes through it, or else when its
/// middle is inside: there is no third way.
class RowSpans {
 public:
  /// `polygon` is simple and stays alive; `convex` (checked by the caller) gives one span a row.
  RowSpans(const Polygon& polygon, bool convex);

  [[nodiscard]] std::int32_t first_row() const { return first_row_; }
  [[nodiscard]] std::int32_t last_row() const { return last_row_; }

  /// Calls visit(span) for each span of the row until one call returns true, and returns whether
  /// one did. Spans may overlap; none is empty.
  template <class Visit>
  bool any_in_row(std::int32_t row, Visit&& visit) {
    collect(row);
    for (const ColumnSpan span : spans_) {
      if (span.first <= span.last && visit(span)) return true;
    }
    return false;
  }

 private:
  void collect(std::int32_t row);
  void collect_inside(double middle);

  const Polygon& polygon_;
  bool convex_;
  std::int32_t first_row_ = 0;
  std::int32_t last_row_ = -1;
  std::vector<ColumnSpan> spans_;
  std::vector<double> crossings_;
};

/// The columns whose cells the open interval (low, high) covers a part of; an interval that is a
/// point covers the cell it lies inside of.
[[nodiscard]] ColumnSpan columns_between(double low, double high);

}  // namespace linewright
