#include "routes_hall.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "linewright/base/markup.hpp"

namespace linewright::routes {
namespace {

/// Columns [first, end) of block rows from `low` on that are all in one state.
struct Run {
  std::int32_t first = 0;
  std::int32_t end = 0;
  CellState state = CellState::kFree;
  std::int32_t low = 0;
};

bool same_columns(const Run& a, const Run& b) {
  return a.first == b.first && a.end == b.end && a.state == b.state;
}

/// The grid in square blocks of cells, each about a pixel or a cell wide.
class Blocks {
 public:
  Blocks(const OccupancyGrid& grid, const View& view)
      : grid_(grid),
        size_(std::max(1, static_cast<int>(std::floor(1.0 / (grid.cell_m() * view.scale))))),
        view_(view) {}

  /// Path data of all blocks in each of the two states.
  void draw(std::string& occupied, std::string& unknown) const {
    std::vector<Run> open;
    const std::int32_t rows = (grid_.rows() + size_ - 1) / size_;
    for (std::int32_t row = 0; row <= rows; ++row) {
      std::vector<Run> runs = row < rows ? runs_of(row) : std::vector<Run>();
      for (const Run& before : open) {
        const auto same =
            std::lower_bound(runs.begin(), runs.end(), before,
                             [](const Run& a, const Run& b) { return a.first < b.first; });
        if (same != runs.end() && same_columns(*same, before)) {
          same->low = before.low;
        } else {
          (before.state == CellState::kOccupied ? occupied : unknown) += rectangle(before, row);
        }
      }
      open = std::move(runs);
    }
  }

 private:
  /// Occupied when one of its cells is, else unknown when one of them is.
  [[nodiscard]] CellState state_of(std::int32_t column, std::int32_t row) const {
    CellState state = CellState::kFree;
    for (std::int32_t r = row * size_; r < std::min(grid_.rows(), (row + 1) * size_); ++r) {
      for (std::int32_t c = column * size_; c < std::min(grid_.columns(), (column + 1) * size_);
           ++c) {
        const CellState cell = grid_.state({c, r});
        if (cell == CellState::kOccupied) return cell;
        if (cell == CellState::kUnknown) state = cell;
      }
    }
    return state;
  }

  [[nodiscard]] std::vector<Run> runs_of(std::int32_t row) const {
    std::vector<Run> runs;
    const std::int32_t columns = (grid_.columns() + size_ - 1) / size_;
    for (std::int32_t column = 0; column < columns; ++column) {
      const CellState state = state_of(column, row);
      if (state == CellState::kFree) continue;
      if (!runs.empty() && runs.back().end == column && runs.back().state == state) {
        ++runs.back().end;
      } else {
        runs.push_back({column, column + 1, state, row});
      }
    }
    return runs;
  }

  [[nodiscard]] std::string rectangle(const Run& run, std::int32_t top) const {
    const auto corner = [&](std::int32_t column, std::int32_t row) {
      return grid_.frame().to_map(Point2{std::min(column * size_, grid_.columns()) * grid_.cell_m(),
                                         std::min(row * size_, grid_.rows()) * grid_.cell_m()});
    };
    return outline({corner(run.first, run.low), corner(run.end, run.low), corner(run.end, top),
                    corner(run.first, top)},
                   view_);
  }

  const OccupancyGrid& grid_;
  std::int32_t size_;  ///< cells
  const View& view_;
};

/// The rows of a map file may be turned against the hall's bounds.
Polygon floor_of(const HallMap& map) {
  if (map.occupancy.empty()) return corners_of(map.bounds);
  const GridFrame& frame = map.grid->frame();
  Polygon corners = corners_of({0.0, frame.columns * frame.cell_m, 0.0, frame.rows * frame.cell_m});
  for (Point2& corner : corners) corner = frame.to_map(corner);
  return corners;
}

std::string filled(const char* style, const std::string& data) {
  return data.empty() ? "" : fmt::format("<path class=\"{}\" d=\"{}\"/>\n", style, data);
}

/// 1, 2 or 5 times a power of ten, about a sixth of the hall.
double bar_m(const View& view) {
  const double most = (view.hall.x1_m - view.hall.x0_m) / 5.0;
  const double power = std::pow(10.0, std::floor(std::log10(most)));
  for (const double factor : {5.0, 2.0}) {
    if (factor * power <= most) return factor * power;
  }
  return power;
}

}  // namespace

std::string floor_svg(const Polygon& floor, const std::string& cells, const std::string& obstacles,
                      const View& view) {
  const std::string edge = outline(floor, view);
  // Obstacles may stick out of the hall.
  return fmt::format("<clipPath id=\"lw-floor\"><path d=\"{}\"/></clipPath>\n", edge) +
         filled("floor", edge) + "<g clip-path=\"url(#lw-floor)\">\n" + cells +
         filled("block", obstacles) + "</g>\n" + filled("wall", edge);
}

std::string hall_svg(const HallMap& map, const View& view) {
  std::string cells;
  if (!map.occupancy.empty()) {
    std::string occupied;
    std::string unknown;
    Blocks(*map.grid, view).draw(occupied, unknown);
    cells = filled("unknown", unknown) + filled("cells", occupied);
  }
  std::string obstacles;
  for (const Obstacle& obstacle : map.obstacles) obstacles += outline(obstacle.polygon, view);
  return floor_svg(floor_of(map), cells, obstacles, view);
}

std::string scale_bar(const View& view, double right) {
  const double metres = bar_m(view);
  const double left = right - metres * view.scale;
  return fmt::format(
      "<path class=\"bar-line\" d=\"M{0} 7v8M{0} 11H{1}M{1} 7v8\"/>\n"
      "<text class=\"ink end\" x=\"{2}\" y=\"15\">{3:.6g} m</text>\n",
      markup::coordinate(left), markup::coordinate(right), markup::coordinate(left - 8.0), metres);
}

}  // namespace linewright::routes
