#include "linewright/routing/path.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace linewright {
namespace {

using Kind = PathSegment::Kind;

/// Pieces that are driven without standing still in between: [first, last), metres in all.
struct Run {
  std::size_t first = 0;
  std::size_t last = 0;
  double metres = 0.0;
};

bool is_turn(const PathSegment& segment) { return segment.kind == Kind::kTurn; }

Run run_from(const Path& path, std::size_t first) {
  Run run{.first = first, .last = first + 1, .metres = std::abs(path.segments[first].amount)};
  const bool backwards = path.segments[first].amount < 0.0;
  while (run.last < path.segments.size() && !is_turn(path.segments[run.last]) &&
         (path.segments[run.last].amount < 0.0) == backwards) {
    run.metres += std::abs(path.segments[run.last++].amount);
  }
  return run;
}

/// Seconds after which `gone` of the `metres` from standstill to standstill are done.
double seconds_at(double gone, double metres, const Motion& motion) {
  const double a = motion.acceleration_mps2;
  if (a <= 0.0) return gone / motion.speed_mps;
  // Up to the speed, or, on a short way, to its middle.
  const double ramp = std::min(motion.speed_mps * motion.speed_mps / (2.0 * a), metres / 2.0);
  const double top = std::sqrt(2.0 * a * ramp);
  const double total = 2.0 * top / a + (metres - 2.0 * ramp) / top;
  if (gone <= ramp) return std::sqrt(2.0 * gone / a);
  if (gone >= metres - ramp) return total - std::sqrt(2.0 * std::max(0.0, metres - gone) / a);
  return top / a + (gone - ramp) / top;
}

double turn_seconds(double angle_rad, const Motion& motion) {
  return motion.turn_rate_radps > 0.0 ? std::abs(angle_rad) / motion.turn_rate_radps : 0.0;
}

/// Poses with the seconds at which they are passed.
struct Timed {
  std::vector<WayPoint> points;
  double seconds = 0.0;
};

/// Walks along a path piece by piece.
class Timer {
 public:
  Timer(const Path& path, const Motion& motion, double arc_step_rad)
      : path_(path), motion_(motion), arc_step_rad_(arc_step_rad), pose_(path.start) {}

  Timed walk() {
    timed_.points.push_back({pose_, 0.0});
    for (std::size_t i = 0; i < path_.segments.size();) {
      if (is_turn(path_.segments[i])) {
        timed_.seconds += turn_seconds(path_.segments[i].amount, motion_);
        pose_ = advanced(pose_, Kind::kTurn, path_.segments[i].amount, 0.0);
        timed_.points.push_back({pose_, timed_.seconds});
        ++i;
        continue;
      }
      const Run run = run_from(path_, i);
      drive(run);
      i = run.last;
    }
    return std::move(timed_);
  }

 private:
  void drive(const Run& run) {
    double gone = 0.0;
    for (std::size_t i = run.first; i < run.last; ++i) {
      const PathSegment& segment = path_.segments[i];
      const double metres = std::abs(segment.amount);
      const int steps = steps_of(segment);
      for (int s = 1; s <= steps; ++s) {
        const double share = static_cast<double>(s) / steps;
        const Pose2 at =
            advanced(pose_, segment.kind, segment.amount * share, path_.turning_radius_m);
        const double seconds =
            timed_.seconds + seconds_at(gone + metres * share, run.metres, motion_);
        timed_.points.push_back({at, seconds});
      }
      pose_ = timed_.points.back().pose;
      gone += metres;
    }
    timed_.seconds += seconds_at(run.metres, run.metres, motion_);
  }

  [[nodiscard]] int steps_of(const PathSegment& segment) const {
    double parts = 1.0;
    if (segment.kind != Kind::kStraight) {
      parts = std::abs(segment.amount) / path_.turning_radius_m / arc_step_rad_;
    }
    // While it speeds up, time is not proportional to the way.
    if (motion_.acceleration_mps2 > 0.0) parts = std::max(parts, std::abs(segment.amount) / 0.5);
    return std::max(1, static_cast<int>(std::ceil(parts)));
  }

  const Path& path_;
  const Motion& motion_;
  double arc_step_rad_;
  Pose2 pose_;
  Timed timed_;
};

}  // namespace

const char* name_of(PathStatus status) {
  switch (status) {
    case PathStatus::kFound:
      return "found";
    case PathStatus::kStartOccupied:
      return "start occupied";
    case PathStatus::kGoalOccupied:
      return "goal occupied";
    case PathStatus::kNoAisle:
      return "no aisle wide enough";
    case PathStatus::kNoManoeuvre:
      return "no room to manoeuvre";
    case PathStatus::kSearchLimit:
      return "search limit reached";
  }
  return "";
}

double Path::metres() const {
  double sum = 0.0;
  for (const PathSegment& segment : segments)
    sum += is_turn(segment) ? 0.0 : std::abs(segment.amount);
  return sum;
}

double Path::turned_rad() const {
  double sum = 0.0;
  for (const PathSegment& segment : segments)
    sum += is_turn(segment) ? std::abs(segment.amount) : 0.0;
  return sum;
}

int Path::direction_changes() const {
  int changes = 0;
  double before = 0.0;
  for (const PathSegment& segment : segments) {
    if (is_turn(segment)) continue;
    changes += before * segment.amount < 0.0 ? 1 : 0;
    before = segment.amount;
  }
  return changes;
}

Pose2 Path::end() const {
  Pose2 pose = start;
  for (const PathSegment& segment : segments) {
    pose = advanced(pose, segment.kind, segment.amount, turning_radius_m);
  }
  return pose;
}

Pose2 advanced(const Pose2& p, PathSegment::Kind kind, double amount, double radius_m) {
  switch (kind) {
    case Kind::kStraight:
      return {p.x_m + amount * std::cos(p.heading_rad), p.y_m + amount * std::sin(p.heading_rad),
              p.heading_rad};
    case Kind::kTurn:
      return {p.x_m, p.y_m, p.heading_rad + amount};
    case Kind::kLeft:
    case Kind::kRight: {
      const double side = kind == Kind::kLeft ? radius_m : -radius_m;
      const double heading = p.heading_rad + amount / side;
      return {p.x_m + side * (std::sin(heading) - std::sin(p.heading_rad)),
              p.y_m - side * (std::cos(heading) - std::cos(p.heading_rad)), heading};
    }
  }
  return p;
}

std::vector<Pose2> sampled(const Path& path, double step_m, double step_rad) {
  std::vector<Pose2> poses{path.start};
  for (const PathSegment& segment : path.segments) {
    const Pose2 from = poses.back();
    const double step = is_turn(segment) ? step_rad : step_m;
    const int steps = std::max(1, static_cast<int>(std::ceil(std::abs(segment.amount) / step)));
    for (int s = 1; s <= steps; ++s) {
      poses.push_back(
          advanced(from, segment.kind, segment.amount * s / steps, path.turning_radius_m));
    }
  }
  return poses;
}

double travel_seconds(const Path& path, const Motion& motion) {
  double seconds = 0.0;
  for (std::size_t i = 0; i < path.segments.size();) {
    if (is_turn(path.segments[i])) {
      seconds += turn_seconds(path.segments[i++].amount, motion);
      continue;
    }
    const Run run = run_from(path, i);
    seconds += seconds_at(run.metres, run.metres, motion);
    i = run.last;
  }
  return seconds;
}

std::vector<WayPoint> way_points(const Path& path, const Motion& motion) {
  constexpr double kArcStep = 0.26;  // 15 degrees: 1 % off the arc at most
  Timed timed = Timer(path, motion, kArcStep).walk();
  for (WayPoint& point : timed.points) {
    point.share = timed.seconds > 0.0 ? std::min(1.0, point.share / timed.seconds) : 1.0;
  }
  timed.points.front().share = 0.0;
  timed.points.back().share = 1.0;
  return std::move(timed.points);
}

}  // namespace linewright
