#pragma once

#include <cstdint>
#include <vector>

#include "linewright/base/geometry.hpp"
#include "linewright/base/id.hpp"
#include "linewright/base/tick.hpp"
#include "linewright/line/line_model.hpp"

namespace linewright {

/// Which line a worker follows from `from` to `to`, as plain data that can be copied and compared:
/// the path itself is found again from the line model. By default that of the line's travel table.
struct Course {
  Pose2 origin;              ///< with `from_pose`: where it begins
  ZoneSet planned_with = 0;  ///< the zones that were closed when it was planned
  bool from_pose = false;    ///< it begins at `origin`, not at a station
  // Where only times are known (no WayFinder), a worker called on its way from `turn_from` to
  // `turn_to` goes on to, or back to, one of the two first: the station `from` of the new way.
  std::int16_t turn_from = -1;  ///< -1: not so
  std::int16_t turn_to = -1;
  Tick turn_ticks = 0;      ///< until it is there
  double turn_share = 0.0;  ///< share of that way's time that had passed when it was called

  [[nodiscard]] bool turns() const { return turn_from >= 0; }
};

/// A course with its two ends, as it is logged.
struct CourseEnds {
  WorkerKindId kind;
  StationId from;  ///< of a course from a pose: without meaning
  StationId to;
  Tick ticks = 0;  ///< from departure to arrival
};

/// Ticks and metres of the course; ticks -1: there is no such way.
[[nodiscard]] Leg course_leg(const LineModel& line, const Course& course, const CourseEnds& ends);

/// The line it follows, both ends included; empty: the straight line between two stations.
[[nodiscard]] std::vector<WayPoint> course_path(const LineModel& line, const Course& course,
                                                const CourseEnds& ends);

}  // namespace linewright
