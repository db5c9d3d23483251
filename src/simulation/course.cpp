#include "linewright/simulation/course.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ways.hpp"

namespace linewright {
namespace {

StationId station(std::int16_t id) { return StationId(std::int32_t{id}); }

const TravelTable& table(const LineModel& line, std::size_t kind, ZoneSet closed) {
  return closed == 0 ? line.travel[kind] : line.ways->table(WorkerKindId(kind), closed);
}

Pose2 pose_of(const LineModel& line, std::size_t kind, StationId id) {
  return line.stations[id.index()].poses[kind].value_or(Pose2{});
}

Pose2 on_straight_line(Pose2 from, Pose2 to, double share) {
  const double heading = std::atan2(to.y_m - from.y_m, to.x_m - from.x_m);
  return {from.x_m + share * (to.x_m - from.x_m), from.y_m + share * (to.y_m - from.y_m), heading};
}

/// On the way of the line's own table.
Pose2 on_leg(const LineModel& line, std::size_t kind, StationId from, StationId to, double share) {
  const std::vector<WayPoint>& path = line.travel[kind].path(from, to);
  if (!path.empty()) return pose_on(path, share);
  return on_straight_line(pose_of(line, kind, from), pose_of(line, kind, to), share);
}

Pose2 turned_round(Pose2 pose) {
  pose.heading_rad = std::remainder(pose.heading_rad + std::numbers::pi, 2 * std::numbers::pi);
  return pose;
}

/// `passed` ticks after a course that turns began, of which it takes `ticks`.
Pose2 on_turning_course(const LineModel& line, std::size_t kind, const Course& course,
                        StationId via, StationId to, double passed, Tick ticks) {
  if (passed >= course.turn_ticks) {
    const Tick rest = std::max(1, ticks - course.turn_ticks);
    return on_leg(line, kind, via, to, std::min(1.0, (passed - course.turn_ticks) / rest));
  }
  const bool on = via == station(course.turn_to);
  const double end = on ? 1.0 : 0.0;
  const double share =
      course.turn_share + (end - course.turn_share) * passed / std::max(1, course.turn_ticks);
  const Pose2 pose = on_leg(line, kind, station(course.turn_from), station(course.turn_to), share);
  return on ? pose : turned_round(pose);
}

/// The stored path of a course that does not turn; empty: a straight line.
const std::vector<WayPoint>& stored_path(const LineModel& line, std::size_t kind,
                                         const Course& course, StationId from, StationId to) {
  if (!course.from_pose) return table(line, kind, course.planned_with).path(from, to);
  return line.ways->way(WorkerKindId(kind), course.origin, to, course.planned_with).path;
}

const std::vector<WayPoint>& path_of(const LineModel& line, const WorkerState& worker) {
  return stored_path(line, static_cast<std::size_t>(worker.kind), worker.course,
                     station(worker.from), station(worker.station));
}

Pose2 start_of(const LineModel& line, const WorkerState& worker) {
  if (worker.course.from_pose || worker.course.turns()) return worker.course.origin;
  return pose_of(line, static_cast<std::size_t>(worker.kind), station(worker.from));
}

double time_share(const WorkerState& worker, Tick at) {
  return static_cast<double>(at - worker.depart) / std::max(1, worker.arrive - worker.depart);
}

/// A new way to a station within a closed zone would lead into it.
bool is_closed(const LineModel& line, std::size_t kind, StationId to, ZoneSet closed) {
  for (std::size_t zone = 0; (closed >> zone) != 0; ++zone) {
    if (((closed >> zone) & 1U) == 0) continue;
    if (line.ways->inside(WorkerKindId(kind), pose_of(line, kind, to), zone)) return true;
  }
  return false;
}

Departure from_station(const LineModel& line, std::size_t kind, StationId from, StationId to,
                       ZoneSet closed) {
  Departure made{.leg = table(line, kind, closed).leg(from, to),
                 .course = {.planned_with = closed},
                 .from = static_cast<std::int16_t>(from.value)};
  if (closed != 0 && from != to && is_closed(line, kind, to, closed)) made.leg = {};
  return made;
}

Departure from_pose(const LineModel& line, std::size_t kind, Pose2 origin, StationId to,
                    ZoneSet closed) {
  Departure made{.leg = {},
                 .course = {.origin = origin, .planned_with = closed, .from_pose = true},
                 .from = static_cast<std::int16_t>(to.value)};
  if (!is_closed(line, kind, to, closed)) {
    made.leg = line.ways->way(WorkerKindId(kind), origin, to, closed).leg;
  }
  return made;
}

/// By measured times alone: on to the end of the way it is on, or back to its beginning, whichever
/// is sooner at the goal.
Departure turning(const LineModel& line, const WorkerState& worker, StationId to, Tick at) {
  const auto kind = static_cast<std::size_t>(worker.kind);
  const TravelTable& travel = line.travel[kind];
  const Leg& on = travel.leg(station(worker.station), to);
  const Leg& back = travel.leg(station(worker.from), to);
  const Tick left = worker.arrive - at;
  const Tick gone = at - worker.depart;
  const bool turn = back.ticks >= 0 && (on.ticks < 0 || gone + back.ticks < left + on.ticks);
  Departure made;
  made.course = {.origin = pose_at(line, worker, at),
                 .turn_from = worker.from,
                 .turn_to = worker.station,
                 .turn_ticks = turn ? gone : left,
                 .turn_share = time_share(worker, at)};
  made.from = turn ? worker.from : worker.station;
  made.leg = course_leg(line, made.course, {WorkerKindId(kind), station(made.from), to});
  return made;
}

}  // namespace

Leg course_leg(const LineModel& line, const Course& course, const CourseEnds& ends) {
  if (course.from_pose) {
    return line.ways->way(ends.kind, course.origin, ends.to, course.planned_with).leg;
  }
  Leg leg = table(line, ends.kind.index(), course.planned_with).leg(ends.from, ends.to);
  if (!course.turns() || leg.ticks < 0) return leg;
  const StationId goal = station(course.turn_to);
  const double part = ends.from == goal ? 1.0 - course.turn_share : course.turn_share;
  leg.ticks += course.turn_ticks;
  leg.metres += part * line.travel[ends.kind.index()].leg(station(course.turn_from), goal).metres;
  return leg;
}

std::vector<WayPoint> course_path(const LineModel& line, const Course& course,
                                  const CourseEnds& ends) {
  const std::size_t kind = ends.kind.index();
  if (!course.turns()) return stored_path(line, kind, course, ends.from, ends.to);
  // Through every point of the two ways, at the tick at which it is passed.
  std::vector<double> shares{0.0, 1.0};
  const double all = std::max(1, ends.ticks);
  const double first = course.turn_ticks / all;
  shares.push_back(first);
  const double end = ends.from == station(course.turn_to) ? 1.0 : 0.0;
  const auto& turned = line.travel[kind].path(station(course.turn_from), station(course.turn_to));
  for (const WayPoint& point : turned) {
    const double part = (point.share - course.turn_share) / (end - course.turn_share);
    if (part > 0.0 && part < 1.0) shares.push_back(part * first);
  }
  for (const WayPoint& point : line.travel[kind].path(ends.from, ends.to)) {
    shares.push_back(first + point.share * (1.0 - first));
  }
  std::sort(shares.begin(), shares.end());
  shares.erase(std::unique(shares.begin(), shares.end()), shares.end());
  std::vector<WayPoint> path;
  for (const double share : shares) {
    path.push_back(
        {on_turning_course(line, kind, course, ends.from, ends.to, share * all, ends.ticks),
         share});
  }
  return path;
}

bool between_stations(const WorkerState& worker, Tick at) {
  if (worker.no_way) return worker.course.from_pose;
  if (worker.arrive <= at) return false;
  return worker.depart < at || worker.course.from_pose || worker.course.turns();
}

Pose2 pose_at(const LineModel& line, const WorkerState& worker, Tick at) {
  const auto kind = static_cast<std::size_t>(worker.kind);
  const Pose2 to = pose_of(line, kind, station(worker.station));
  if (worker.no_way) return worker.course.from_pose ? worker.course.origin : to;
  if (at >= worker.arrive || worker.arrive <= worker.depart) return to;
  const Pose2 from = start_of(line, worker);
  if (at <= worker.depart) return from;
  if (worker.course.turns()) {
    return on_turning_course(line, kind, worker.course, station(worker.from),
                             station(worker.station), at - worker.depart,
                             worker.arrive - worker.depart);
  }
  const std::vector<WayPoint>& path = path_of(line, worker);
  const double share = time_share(worker, at);
  return path.empty() ? on_straight_line(from, to, share) : pose_on(path, share);
}

Departure departure(const LineModel& line, const WorkerState& worker, StationId to, Tick at,
                    ZoneSet closed) {
  const auto kind = static_cast<std::size_t>(worker.kind);
  if (!between_stations(worker, at)) {
    const bool not_left = !worker.no_way && worker.arrive > at;
    return from_station(line, kind, station(not_left ? worker.from : worker.station), to, closed);
  }
  if (line.ways != nullptr) {
    Departure made = from_pose(line, kind, pose_at(line, worker, at), to, closed);
    // Of a kind that is not on the map only times are known.
    if (made.leg.ticks >= 0 || closed != 0 || worker.course.from_pose) return made;
  }
  return turning(line, worker, to, at);
}

double share_left(const LineModel& line, const WorkerState& worker, Tick at) {
  if (at <= worker.depart) return 1.0;
  const double passed = time_share(worker, at);
  if (worker.course.turns()) return 1.0 - passed;
  const std::vector<WayPoint>& path = path_of(line, worker);
  if (path.empty()) return 1.0 - passed;
  // By length: turning on the spot takes time but no metres.
  double all = 0.0;
  double left = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double part = distance_m(path[i - 1].pose.point(), path[i].pose.point());
    const double span = path[i].share - path[i - 1].share;
    all += part;
    if (path[i - 1].share >= passed) {
      left += part;
    } else if (path[i].share > passed) {
      left += part * (path[i].share - passed) / span;
    }
  }
  return all > 0.0 ? left / all : 0.0;
}

bool runs_into(const LineModel& line, const WorkerState& worker, Tick at, ZoneSet zones) {
  const WorkerKindId kind(std::int32_t{worker.kind});
  if (zones == 0 || worker.course.turns()) return false;
  const std::vector<WayPoint>* path = &path_of(line, worker);
  std::vector<WayPoint> straight;
  if (path->empty()) {
    straight = {{start_of(line, worker), 0.0},
                {pose_of(line, kind.index(), station(worker.station)), 1.0}};
    path = &straight;
  }
  const double share = at <= worker.depart ? 0.0 : time_share(worker, at);
  const Pose2 pose = pose_at(line, worker, at);
  for (std::size_t zone = 0; (zones >> zone) != 0; ++zone) {
    if (((zones >> zone) & 1U) == 0) continue;
    if (line.ways->crosses(kind, *path, share, zone) && !line.ways->inside(kind, pose, zone)) {
      return true;
    }
  }
  return false;
}

}  // namespace linewright
