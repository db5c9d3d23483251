#pragma once

#include "linewright/line/line_model.hpp"
#include "linewright/simulation/course.hpp"
#include "linewright/simulation/state.hpp"

// Where workers are on their ways, and which ways lead on from there. Shared by the engine and the
// questions that Simulator answers, so that both say the same.
namespace linewright {

/// A way that a worker can set out on.
struct Departure {
  Leg leg;  ///< ticks -1: there is none
  Course course;
  std::int16_t from = 0;  ///< the station it leads from (a course from a pose: where it leads to)
};

/// The way from where the worker is at `at`, or where it is going to stand then, to a station.
/// With closed zones: none when the station lies in one.
[[nodiscard]] Departure departure(const LineModel& line, const WorkerState& worker, StationId to,
                                  Tick at, ZoneSet closed);

/// Where the worker is at `at`.
[[nodiscard]] Pose2 pose_at(const LineModel& line, const WorkerState& worker, Tick at);

/// Whether it stands neither at a station nor at the beginning of a way that leads from one.
[[nodiscard]] bool between_stations(const WorkerState& worker, Tick at);

/// Which part of the length of its way lies before it at `at`, 0 ... 1.
[[nodiscard]] double share_left(const LineModel& line, const WorkerState& worker, Tick at);

/// Whether the rest of its way touches one of the zones from outside: who is inside leaves.
[[nodiscard]] bool runs_into(const LineModel& line, const WorkerState& worker, Tick at,
                             ZoneSet zones);

}  // namespace linewright
