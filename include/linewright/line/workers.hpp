#pragma once

#include <optional>
#include <string>
#include <vector>

#include "linewright/base/geometry.hpp"
#include "linewright/base/id.hpp"
#include "linewright/base/tick.hpp"

namespace linewright {

/// How many there are: fixed (min == max) or drawn uniformly at reset.
struct CountRange {
  std::int32_t min = 1;
  std::int32_t max = 1;
};

/// A kind of agent that moves by itself.
struct WorkerKind {
  std::string name;
  CountRange count;
  double speed_mps = 1.0;
  double radius_m = 0.3;            ///< of the circle around it
  std::vector<double> footprint_m;  ///< {length, width}, or empty: `outline_m`
  std::vector<Point2> outline_m;    ///< simple polygon around the pose, x forward; or empty: a
                                    ///< circle of radius_m
  double turning_radius_m = 0.0;
  double turn_rate_radps = 0.0;    ///< turning on the spot; 0: takes no time
  double acceleration_mps2 = 0.0;  ///< from and to standstill; 0: full speed at once
  Tick min_leg_ticks = 0;          ///< a `go` takes at least this long, also to where it stands
  std::vector<StationId> start;    ///< worker i starts at start[i]; empty: drawn among the stations
                                   ///< of this kind without replacement (Station::slots each)
  /// Where a worker without a task goes (the nearest of these, ties: the first one), so that the
  /// next task finds it well placed; it stays free on the way. Empty: it stays where it is.
  std::vector<StationId> rest;
  Tick rest_after = 0;  ///< ticks without a task before it leaves for there
};

/// A kind of thing that workers move and that holds up to `capacity` items of one material.
struct CarrierKind {
  std::string name;
  CountRange count;
  std::optional<WorkerKindId>
      count_as;  ///< as many as there are workers of this kind (overrides count)
  std::int32_t capacity = 1;
  WorkerKindId moved_by;
  std::vector<StationId> start;  ///< as WorkerKind::start; drawn among the mover's stations
};

/// A working area with a pose per kind of worker.
struct Station {
  std::string name;
  std::vector<std::optional<Pose2>>
      poses;                        ///< by worker kind; none: that kind has no business there
  std::vector<std::int32_t> slots;  ///< by worker kind: how many may start there (default 1)
};

/// One way from a station to another.
struct Leg {
  Tick ticks = -1;  ///< -1: no way known
  double metres = 0.0;
};

/// A pose on a way, and when it is passed: as a share of the travel time, 0 (departure) ... 1
/// (arrival).
struct WayPoint {
  Pose2 pose;
  double share = 0.0;
};

/// The way between every ordered pair of stations for one kind of worker, and the line it follows.
class TravelTable {
 public:
  TravelTable() = default;
  explicit TravelTable(std::size_t stations) : stations_(stations), legs_(stations * stations) {
    for (std::size_t i = 0; i < stations; ++i) legs_[i * stations + i] = Leg{0, 0.0};
  }

  [[nodiscard]] const Leg& leg(StationId from, StationId to) const {
    return legs_[from.index() * stations_ + to.index()];
  }
  void set(StationId from, StationId to, Leg leg) {
    legs_[from.index() * stations_ + to.index()] = leg;
  }

  /// The line that the leg follows, both ends included, shares ascending; empty: the straight line
  /// between the two poses.
  [[nodiscard]] const std::vector<WayPoint>& path(StationId from, StationId to) const;
  void set_path(StationId from, StationId to, std::vector<WayPoint> path);

 private:
  std::size_t stations_ = 0;
  std::vector<Leg> legs_;
  std::vector<std::vector<WayPoint>> paths_;  ///< empty unless a path was set
};

}  // namespace linewright
