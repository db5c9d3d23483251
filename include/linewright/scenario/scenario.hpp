#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "linewright/base/diagnostic.hpp"
#include "linewright/line/line_model.hpp"
#include "linewright/map/occupancy_grid.hpp"
#include "linewright/map/polygon.hpp"
#include "linewright/routing/map_ways.hpp"

namespace linewright {

/// Something in the hall that nothing drives through.
struct Obstacle {
  std::string name;
  Polygon polygon;        ///< simple, counter-clockwise, in the frame `map`
  double height_m = 1.0;  ///< > 0; for pictures
};

/// The hall as the scenario describes it; for pictures and for routes on the grid.
struct HallMap {
  Rectangle bounds;                 ///< around the grid, whose rows may be turned against it
  double cell_m = 0.25;             ///< of the grid
  std::vector<Obstacle> obstacles;  ///< declared in the scenario
  std::string occupancy;  ///< the map file (docs/formats/map.md) that was read; empty: none
  /// What the map file says, or free cells without one, and on it all obstacles. Never null.
  std::shared_ptr<const OccupancyGrid> grid;
};

/// A scenario file, read, resolved and checked: every id in `line` is valid, every travel time that
/// a task can need is there.
struct Scenario {
  LineModel line;
  std::optional<HallMap> map;
  /// By worker kind; none: its ways are measured, or straight lines.
  std::vector<std::optional<KindRoutes>> routes;
  /// What is odd but no error, for the user.
  std::vector<Diagnostic> warnings;
  std::string file;  ///< as the user named it
  std::uint64_t content_hash =
      0;  ///< of the resolved text (files merged) and the map file; the same on every platform
};

}  // namespace linewright
