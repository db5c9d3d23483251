#pragma once

#include <cstdint>
#include <vector>

#include "linewright/base/geometry.hpp"
#include "linewright/base/id.hpp"
#include "linewright/line/workers.hpp"

namespace linewright {

/// A part of the floor that can be closed for a while. While it is closed no new way leads through
/// it; who is inside may leave.
struct Zone {
  std::string name;
  std::vector<Point2> polygon;  ///< simple, counter-clockwise, metres in the frame `map`
  /// When it is closed: [first tick, first tick in which it is open again), ascending, disjoint.
  std::vector<std::pair<Tick, Tick>> closed;
};

/// Most zones of a line: a ZoneSet has a bit for each.
inline constexpr std::size_t kMostZones = 16;

/// Zones that are closed: bit i for LineModel::zones[i].
using ZoneSet = std::uint32_t;

/// A way from anywhere to a station.
struct Way {
  Leg leg;                     ///< ticks -1: there is none
  std::vector<WayPoint> path;  ///< both ends included; empty when there is none
};

/// Finds the ways that the line's travel tables do not have: while zones are closed, and from
/// between two stations. Answers depend on the arguments alone, whatever was asked before; they are
/// remembered, so asking again costs a lookup. Safe to use from several threads at once.
class WayFinder {
 public:
  virtual ~WayFinder() = default;

  /// The ways between the stations while these zones are closed; those that lead through none of
  /// them are the line's own. Lives as long as this object.
  [[nodiscard]] virtual const TravelTable& table(WorkerKindId kind, ZoneSet closed) const = 0;

  /// The way of a worker that stands at `from`, in whatever direction it looks there. Lives as long
  /// as this object.
  [[nodiscard]] virtual const Way& way(WorkerKindId kind, Pose2 from, StationId to,
                                       ZoneSet closed) const = 0;

  /// Whether a worker of the kind that goes on along the path from share `from_share` of its time
  /// would touch the zone.
  [[nodiscard]] virtual bool crosses(WorkerKindId kind, const std::vector<WayPoint>& path,
                                     double from_share, std::size_t zone) const = 0;

  /// Whether a worker of the kind at this pose touches the zone.
  [[nodiscard]] virtual bool inside(WorkerKindId kind, Pose2 pose, std::size_t zone) const = 0;
};

/// The pose at `share` of the travel time of a path (clamped to 0 ... 1); headings turn the short
/// way. The path must not be empty.
[[nodiscard]] Pose2 pose_on(const std::vector<WayPoint>& path, double share);

}  // namespace linewright
