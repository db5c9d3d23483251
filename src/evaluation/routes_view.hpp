#pragma once

#include <string>

#include "linewright/routing/path.hpp"
#include "linewright/scenario/scenario.hpp"

// From metres to pixels, for pictures of the hall.
namespace linewright::routes {

/// A place in a panel: y downwards.
struct Pixel {
  double x = 0.0;
  double y = 0.0;
};

/// Maps the hall into a panel: as large as fits, in the middle, with room around it for names.
struct View {
  Rectangle hall;
  double scale = 1.0;  ///< pixels per metre
  double width = 0.0;  ///< of the panel, pixels
  double height = 0.0;

  [[nodiscard]] Pixel at(Point2 point) const;
  [[nodiscard]] Point2 point(Pixel at) const;

 private:
  [[nodiscard]] double left() const;  ///< of the hall in the panel
};

/// `most_width` and `most_height`: of the hall, pixels.
[[nodiscard]] View view_of(const Rectangle& hall, double most_width = 660.0,
                           double most_height = 520.0);

/// Path data of a closed polygon.
[[nodiscard]] std::string outline(const Polygon& polygon, const View& view);

/// A path as SVG path data with exact arcs; turns on the spot leave no trace.
struct DrawnPath {
  std::string forwards;   ///< empty: no such pieces
  std::string backwards;  ///< pieces driven backwards
};
[[nodiscard]] DrawnPath drawn(const Path& path, const View& view);

}  // namespace linewright::routes
