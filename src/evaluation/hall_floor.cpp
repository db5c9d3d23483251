#include "hall_floor.hpp"

#include <algorithm>

namespace linewright::hall {
namespace {

/// Grows a box point by point.
struct Reach {
  Rectangle box{1e9, -1e9, 1e9, -1e9};

  void add(Point2 point) {
    box.x0_m = std::min(box.x0_m, point.x_m);
    box.x1_m = std::max(box.x1_m, point.x_m);
    box.y0_m = std::min(box.y0_m, point.y_m);
    box.y1_m = std::max(box.y1_m, point.y_m);
  }
};

}  // namespace

Rectangle floor_of(const LogHeader& header) {
  constexpr double kSmallest = 1.0;  // metres
  Reach reach;
  if (header.hall) {
    const LogRectangle& bounds = header.hall->bounds;
    reach.add({bounds.x0_m, bounds.y0_m});
    reach.add({bounds.x1_m, bounds.y1_m});
  } else {
    for (const LogStation& station : header.stations) {
      for (const auto& [kind, pose] : station.poses) reach.add(pose.point());
    }
    for (const LogMachineSite& site : header.machine_sites) {
      for (const Point2 corner : site.area_m) reach.add(corner);
    }
    for (const LogZone& zone : header.zones) {
      for (const Point2 corner : zone.polygon) reach.add(corner);
    }
  }
  Rectangle box = reach.box;
  if (box.x0_m > box.x1_m) box = {0.0, kSmallest, 0.0, kSmallest};  // nothing has a place
  const double size = std::max({box.x1_m - box.x0_m, box.y1_m - box.y0_m, kSmallest});
  // A hall on a line would be infinitely flat.
  const double margin = header.hall ? 0.0 : 0.08 * size;
  const double more_x = std::max(margin, (size / 4.0 - (box.x1_m - box.x0_m)) / 2.0);
  const double more_y = std::max(margin, (size / 4.0 - (box.y1_m - box.y0_m)) / 2.0);
  return {box.x0_m - more_x, box.x1_m + more_x, box.y0_m - more_y, box.y1_m + more_y};
}

}  // namespace linewright::hall
