#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "linewright/base/geometry.hpp"
#include "linewright/base/tick.hpp"
#include "linewright/evaluation/gantt.hpp"
#include "linewright/evaluation/log_document.hpp"

namespace linewright {

struct SceneWorker {
  Pose2 pose;
  StationId station;                   ///< where it stands or is going
  bool moving = false;                 ///< between two stations
  std::vector<Point2> ahead;           ///< the rest of its way from the pose on; empty: it stands
  std::optional<GanttInterval> doing;  ///< none: it is free
  std::optional<CarrierId> carrier;    ///< that it holds
};

struct SceneCarrier {
  std::string moved_by;  ///< kind of worker, as far as the log shows; else "robot"
  Pose2 pose;
  StationId station;  ///< where it stands; while it is held: where it was taken from
  std::optional<WorkerId> holder;
  std::optional<PlaceId> berth;  ///< in which it stands or, where the log says so, will stand
  std::string of;                ///< kind of material in it; empty: nothing
  std::int64_t items = 0;
};

/// Where everything is and what everyone does at one moment of a recorded run.
struct HallScene {
  Tick tick = 0;
  std::vector<SceneWorker> workers;                    ///< by WorkerId
  std::vector<SceneCarrier> carriers;                  ///< by CarrierId
  std::vector<std::optional<GanttInterval>> machines;  ///< by MachineId; none: idle
  std::vector<std::int64_t> tokens;                    ///< by PlaceId; a berth: of its carrier
  std::vector<bool> closed;                            ///< by ZoneId
  std::int32_t decisions = 0;                          ///< taken so far
};

/// The scene once everything has happened that the log has for `tick` and before (a tick after the
/// end: the end). Workers under way are interpolated along their way, carriers that are held are
/// where their holder is. What someone does is as in the Gantt chart of the run.
[[nodiscard]] HallScene hall_scene(const LogDocument& log, Tick tick);

}  // namespace linewright
