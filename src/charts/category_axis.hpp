#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "drawing.hpp"

// The axis of names at the bottom of a plot.
namespace linewright::charts {

/// Level where all names fit side by side in a few lines, and else slanted; where even that is too
/// narrow, only every `every`-th is written.
struct CategoryAxis {
  std::vector<std::vector<std::string>> names;  ///< their lines
  bool slanted = false;
  std::size_t every = 1;
  double height = 0.0;  ///< of the names, below the plot
};

/// For a plot that begins at `left` and is about `width` wide.
[[nodiscard]] CategoryAxis make_category_axis(const std::vector<std::string>& names, double left,
                                              double width);

[[nodiscard]] std::string draw_category_axis(const CategoryAxis& axis, const Box& plot);

}  // namespace linewright::charts
