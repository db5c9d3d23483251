#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "linewright/base/tick.hpp"
#include "linewright/simulation/assignment.hpp"
#include "linewright/simulation/course.hpp"
#include "linewright/simulation/run_setup.hpp"
#include "linewright/simulation/state.hpp"

namespace linewright {

/// One thing that happened. What the numbers mean depends on `type`; ids are those of the line,
/// workers and carriers are numbered as in the run. The written form is docs/formats/event_log.md.
struct LogEvent {
  enum class Type : std::uint8_t {
    kDecision,  ///< a = task, b = execution serial, members = crew
    kJoin,      ///< a = worker, b = serial, c = crew slot
    kTaskEnd,   ///< a = task, b = serial
    kRelease,   ///< a = worker, b = serial
    kGo,        ///< a = worker, b = serial (-1: free), c = from station, d = to station, e =
                ///< departure, until = arrival, course
    kReroute,   ///< as kGo, from between two stations: a course from a pose, or one that turns
                ///< (which begins at course.origin, too)
    kBlocked,   ///< a = worker, d = to station; course.origin: where it waits
    kZone,      ///< a = zone, b = 1: it closes, 0: it opens
    kPickUp,    ///< a = worker, b = serial, c = carrier
    kPutDown,   ///< a = worker (or -1), b = serial, c = carrier, d = berth or -1, e = station
    kBerth,  ///< a = carrier, b = serial, c = berth: counts as standing there from now on, though
             ///< it is still on its way (BerthOccupied::kOnAssignment)
    kTransfer,  ///< a = worker, b = serial, c = source, d = destination (place, or -1 - carrier),
                ///< until = put down
    kOperationStart,  ///< a = operation, b = worker or -1, until = products out
    kOperationEnd,    ///< a = operation
    kRecoveryEnd,     ///< a = operation
    kMilestone,       ///< a = milestone
    kEnd,             ///< a = RunStatus
  };

  Tick tick = 0;
  Type type = Type::kDecision;
  std::int32_t a = -1;
  std::int32_t b = -1;
  std::int32_t c = -1;
  std::int32_t d = -1;
  std::int32_t e = -1;
  Tick until = 0;
  std::array<std::int16_t, kMaxCrew> members{};
  Course course;
};

/// Everything that happened in a run, in order. With its setup and its line it suffices to draw,
/// replay and audit the run.
struct EventLog {
  RunSetup setup;
  std::vector<LogEvent> events;
};

}  // namespace linewright
