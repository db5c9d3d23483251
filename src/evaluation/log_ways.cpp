#include "log_ways.hpp"

#include <utility>
#include <vector>

namespace linewright::event_log {

using Json = nlohmann::ordered_json;

void write_way(Json& out, const LineModel& line, const LogEvent& event, WorkerKindId kind) {
  const CourseEnds ends{kind, StationId(event.c), StationId(event.d), event.until - event.e};
  out["departs"] = event.e;
  out["arrives"] = event.until;
  out["metres"] = course_leg(line, event.course, ends).metres;
  if (event.type == LogEvent::Type::kGo && ends.from == ends.to) return;  // it stands there already
  for (const WayPoint& point : course_path(line, event.course, ends)) {
    out["path"].push_back({point.pose.x_m, point.pose.y_m, point.pose.heading_rad, point.share});
  }
}

Json pose_json(const Pose2& pose) { return {pose.x_m, pose.y_m, pose.heading_rad}; }

Json zone_list(const LineModel& line, const RunSetup& setup) {
  Json list = Json::array();
  for (std::size_t z = 0; z < line.zones.size(); ++z) {
    Json polygon = Json::array();
    for (const Point2 corner : line.zones[z].polygon) polygon.push_back({corner.x_m, corner.y_m});
    Json closed = Json::array();
    for (const Closure& closure : setup.closures) {
      if (closure.zone != static_cast<std::int32_t>(z)) continue;
      closed.push_back({closure.first, closure.open - closure.first});
    }
    list.push_back({{"name", line.zones[z].name},
                    {"polygon", std::move(polygon)},
                    {"closed", std::move(closed)}});
  }
  return list;
}

}  // namespace linewright::event_log
