#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "linewright/line/line_model.hpp"

namespace linewright {

/// An axis-parallel obstacle of the hall, metres, in the frame `map`.
struct Obstacle {
  std::string name;
  double x0_m = 0.0;
  double x1_m = 0.0;
  double y0_m = 0.0;
  double y1_m = 0.0;
};

/// The hall as the scenario describes it; for pictures and for routes on the grid.
struct HallMap {
  double x0_m = 0.0;
  double x1_m = 0.0;
  double y0_m = 0.0;
  double y1_m = 0.0;
  double cell_m = 0.25;
  std::vector<Obstacle> obstacles;
};

/// A scenario file, read, resolved and checked: every id in `line` is valid, every travel time that
/// a task can need is there.
struct Scenario {
  LineModel line;
  std::optional<HallMap> map;
  std::string file;             ///< as the user named it
  std::uint64_t content_hash = 0;  ///< of the resolved text (files merged); the same on every platform
};

}  // namespace linewright
