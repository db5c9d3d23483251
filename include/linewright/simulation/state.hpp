#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "linewright/base/id.hpp"
#include "linewright/base/tick.hpp"
#include "linewright/simulation/assignment.hpp"
#include "linewright/simulation/course.hpp"

namespace linewright {

/// How a run stands.
enum class RunStatus : std::uint8_t {
  kDecision,  ///< a task is selectable: the next decision is due at tick now + 1
  kJoin,  ///< a worker is free whom a running task waits for: bind one (Simulator::join) at tick
          ///< now + 1
  kFinished,  ///< done_when holds; `now` is the makespan
  kDeadlock,  ///< nothing is under way and nothing is selectable; more time does not help
  kHorizon,   ///< the horizon has passed
  kRunning,   ///< between the above; `Simulator::advance` goes on
};

/// One worker of the run. While it moves, `from` and `station` are the ends of its way, `course` is
/// the line it follows and `depart`, `arrive` are the ticks; standing, `station` is where it stands
/// and `arrive` <= now. With `no_way` it stands where it had to stop: at `course.origin`, on its
/// way to `station` (a course from a pose), or at `station`.
struct WorkerState {
  enum class Phase : std::uint8_t {
    kNone,
    kBefore,
    kMain,
    kWaiting,  ///< for tokens, room or machines
    kAfter,
    kArriving,  ///< its first action is no way, and it was called on its way to where it rests
    kNoWay,     ///< its way leads through a closed zone
  };

  std::int16_t kind = 0;
  std::int16_t station = 0;
  std::int16_t from = 0;
  std::int16_t execution = -1;  ///< index into SimulationState::executions; -1: free
  std::int16_t slot = -1;       ///< crew slot within the execution
  std::int16_t carrier = -1;    ///< the carrier it holds
  std::int16_t action = -1;     ///< index within its sequence of the current step
  Phase phase = Phase::kNone;
  bool no_way = false;     ///< there is none while the zones are closed that are: it waits
  std::int32_t items = 0;  ///< items moved in the current transfer
  Tick depart = 0;
  Tick arrive = 0;
  Tick since = 0;       ///< tick of the assignment, or of becoming free
  Tick work_since = 0;  ///< when the item in hand was picked up or the operation started
  Course course;
  Tick way_ticks = 0;       ///< of the way it is on (or was last), as counted in travel_ticks
  std::int64_t way_mm = 0;  ///< the same in travel_mm
  // Totals of the run so far.
  Tick travel_ticks = 0;
  Tick rest_ticks = 0;  ///< those of travel_ticks in which it was free: on its way to rest
  Tick work_ticks = 0;
  Tick assigned_ticks = 0;
  std::int64_t travel_mm = 0;

  [[nodiscard]] bool free() const { return execution < 0; }
};

/// One carrier of the run. While it stands in a berth its items are the berth's tokens.
struct CarrierState {
  std::int16_t kind = 0;
  std::int16_t station = 0;
  std::int16_t execution = -1;
  std::int16_t holder = -1;    ///< the worker that moves it
  std::int16_t berth = -1;     ///< place
  std::int16_t material = -1;  ///< of what is in it; -1 when empty
  std::int32_t items = 0;
  std::int32_t leaving = 0;  ///< items reserved to be taken out
  std::int32_t coming = 0;   ///< room reserved for items to be put in

  [[nodiscard]] bool free() const { return execution < 0 && berth < 0; }
};

struct MachineState {
  std::int16_t position = 0;
  bool taken = false;
  Tick rest_since = 0;  ///< when it came to rest there
  Tick taken_at = 0;
  Tick busy_ticks = 0;  ///< total of the run so far, holding included, recovery included
};

/// One execution of a task.
struct Execution {
  std::int16_t task = -1;  ///< -1: unused entry
  std::int16_t step = 0;
  std::int16_t open_sequences = 0;
  std::uint8_t missing = 0;  ///< bit per crew slot: a late joiner not bound yet
  std::uint8_t joining = 0;  ///< bit per crew slot: bound, but its first sequence has not begun yet
  std::uint8_t gone = 0;     ///< bit per crew slot: released, or parked in a berth
  std::uint32_t reserved = 0;  ///< bit per Task::reserves entry still held
  std::int32_t serial = 0;     ///< 1, 2, 3, ... in order of the decisions
  Tick started = 0;
  std::array<std::int16_t, kMaxCrew> members{};
};

/// The complete state of one run: plain data, copyable; copying into an existing state of the same
/// line allocates nothing. Only Simulator changes it.
struct SimulationState {
  struct Event {
    std::uint64_t when = 0;  ///< tick in the upper, order within the tick in the lower half
    std::int32_t operator_worker = -1;

    [[nodiscard]] Tick tick() const { return static_cast<Tick>(when >> 32); }
    [[nodiscard]] std::uint32_t order() const { return static_cast<std::uint32_t>(when); }
  };

  Tick now = 0;  ///< everything up to the end of this tick has happened
  Tick horizon = 0;
  std::int32_t order = 1;
  RunStatus status = RunStatus::kRunning;
  std::int32_t decisions = 0;
  std::int32_t serials = 0;
  std::int32_t missing = 0;          ///< crew slots of running tasks that a late joiner has to fill
  ZoneSet closed = 0;                ///< the zones that are closed
  std::vector<std::int32_t> values;  ///< everything a condition can read; see CompiledLine
  std::vector<std::uint64_t> dirty_operations;
  std::vector<std::uint64_t> dirty_tasks;
  std::vector<std::uint64_t> selectable;  ///< bit per task (and one more: done_when)
  std::vector<WorkerState> workers;
  std::vector<CarrierState> carriers;
  std::vector<MachineState> machines;
  std::vector<Execution> executions;
  std::vector<Event> events;          ///< descending, so that the next one is at the back
  std::vector<std::int16_t> waiting;  ///< workers whose action waits for tokens, room or machines

  [[nodiscard]] bool ended() const {
    return status == RunStatus::kFinished || status == RunStatus::kDeadlock ||
           status == RunStatus::kHorizon;
  }
  [[nodiscard]] bool is_selectable(TaskId task) const {
    return ((selectable[task.index() / 64] >> (task.index() % 64)) & 1U) != 0;
  }
};

}  // namespace linewright
