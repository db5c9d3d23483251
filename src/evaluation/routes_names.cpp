#include "routes_names.hpp"

#include <fmt/format.h>

#include "linewright/base/markup.hpp"

namespace linewright::routes {
namespace {

using markup::coordinate;

constexpr double kSize = 10.0;

/// By its corners: a name is short against what could stick into it.
bool within(const labels::Box& box, const Polygon& polygon, const View& view) {
  Polygon corners;
  for (const Point2 corner : polygon) {
    const Pixel at = view.at(corner);
    corners.push_back({at.x, at.y});
  }
  return contains(corners, {box.x0, box.y0}) && contains(corners, {box.x1, box.y0}) &&
         contains(corners, {box.x1, box.y1}) && contains(corners, {box.x0, box.y1});
}

}  // namespace

labels::Box box_of(const Polygon& polygon, const View& view) {
  const Rectangle r = bounds_of(polygon);
  const Pixel low = view.at({r.x0_m, r.y0_m});
  const Pixel high = view.at({r.x1_m, r.y1_m});
  return {low.x, high.y, high.x, low.y};
}

std::string name_within(const Polygon& polygon, const std::string& name, const View& view,
                        labels::Placer& placer) {
  const double width = markup::text_width(name, kSize) + 2.0;
  const labels::Box all = box_of(polygon, view);
  for (const bool across : {true, false}) {
    const double half_x = (across ? width : kSize) / 2.0;
    const double half_y = (across ? kSize : width) / 2.0;
    for (const double share : {0.5, 0.3, 0.7, 0.15, 0.85}) {
      const double x = (all.x0 + all.x1) / 2.0;
      const double y = all.y0 + (all.y1 - all.y0) * share;
      const labels::Box box{x - half_x, y - half_y, x + half_x, y + half_y};
      if (!within(box, polygon, view) || !placer.take(box)) continue;
      return fmt::format(
          "<text class=\"small mid muted\" transform=\"translate({} {}){}\" "
          "dy=\"3.4\">{}</text>\n",
          coordinate(x), coordinate(y), across ? "" : " rotate(-90)", markup::escaped(name));
    }
  }
  return {};
}

std::string name_beside(const Polygon& polygon, const std::string& name, const View& view,
                        labels::Placer& placer) {
  const double width = markup::text_width(name, kSize) + 2.0;
  const labels::Box all = box_of(polygon, view);
  const double middle = (all.x0 + all.x1) / 2.0;
  const double left = middle - width / 2.0;
  constexpr double kAway = 2.0;
  constexpr double kHeight = kSize + 2.0;
  const double level = (all.y0 + all.y1 - kHeight) / 2.0;
  for (const auto [x, y] : {Pixel{left, all.y1 + kAway}, Pixel{left, all.y0 - kAway - kHeight},
                            Pixel{all.x1 + kAway, level}, Pixel{all.x0 - kAway - width, level}}) {
    if (!placer.take({x, y, x + width, y + kHeight})) continue;
    return fmt::format("<text class=\"small mid muted\" x=\"{}\" y=\"{}\">{}</text>\n",
                       coordinate(x + width / 2.0), coordinate(y + kSize - 0.5),
                       markup::escaped(name));
  }
  return {};
}

}  // namespace linewright::routes
