#include "routes_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "linewright/base/markup.hpp"

namespace linewright::routes {
namespace {

using Kind = PathSegment::Kind;

constexpr double kNarrowest = 420.0;
constexpr double kMargin = 8.0;

std::string pair(Pixel p) { return markup::coordinate(p.x) + " " + markup::coordinate(p.y); }

/// One piece, drawn on from where the pen is.
std::string piece(const PathSegment& segment, const Pose2& from, double radius_m,
                  const View& view) {
  if (segment.kind == Kind::kStraight) {
    return "L" + pair(view.at(advanced(from, segment.kind, segment.amount, radius_m).point()));
  }
  // An arc command cannot tell a full circle from none: no more than half of one at once.
  const double angle = std::abs(segment.amount) / radius_m;
  const int parts = std::clamp(static_cast<int>(std::ceil(angle / 3.0)), 1, 100);
  const bool counter_clockwise = (segment.kind == Kind::kLeft) == (segment.amount > 0.0);
  const std::string radius = markup::coordinate(radius_m * view.scale);
  std::string data;
  for (int part = 1; part <= parts; ++part) {
    const Pose2 to = advanced(from, segment.kind, segment.amount * part / parts, radius_m);
    data += fmt::format("A{0} {0} 0 0 {1} {2}", radius, counter_clockwise ? 0 : 1,
                        pair(view.at(to.point())));
  }
  return data;
}

}  // namespace

double View::left() const { return (width - (hall.x1_m - hall.x0_m) * scale) / 2.0; }

Pixel View::at(Point2 point) const {
  return {left() + (point.x_m - hall.x0_m) * scale, kMargin + (hall.y1_m - point.y_m) * scale};
}

Point2 View::point(Pixel at) const {
  return {hall.x0_m + (at.x - left()) / scale, hall.y1_m - (at.y - kMargin) / scale};
}

View view_of(const Rectangle& hall, double most_width, double most_height) {
  const double width_m = hall.x1_m - hall.x0_m;
  const double height_m = hall.y1_m - hall.y0_m;
  View view{.hall = hall, .scale = std::min(most_width / width_m, most_height / height_m)};
  view.width = std::max(kNarrowest, width_m * view.scale) + 2.0 * kMargin;
  view.height = height_m * view.scale + 2.0 * kMargin;
  return view;
}

std::string outline(const Polygon& polygon, const View& view) {
  std::string data;
  for (const Point2 corner : polygon) data += (data.empty() ? "M" : "L") + pair(view.at(corner));
  return data + "Z";
}

DrawnPath drawn(const Path& path, const View& view) {
  DrawnPath result;
  const std::string* pen = nullptr;  // where the last piece went
  Pose2 pose = path.start;
  for (const PathSegment& segment : path.segments) {
    if (segment.kind != Kind::kTurn) {
      std::string& data = segment.amount < 0.0 ? result.backwards : result.forwards;
      if (pen != &data) data += "M" + pair(view.at(pose.point()));
      data += piece(segment, pose, path.turning_radius_m, view);
      pen = &data;
    }
    pose = advanced(pose, segment.kind, segment.amount, path.turning_radius_m);
  }
  return result;
}

}  // namespace linewright::routes
