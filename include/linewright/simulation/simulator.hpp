#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "linewright/base/geometry.hpp"
#include "linewright/base/id.hpp"
#include "linewright/line/line_model.hpp"
#include "linewright/simulation/assignment.hpp"
#include "linewright/simulation/event_log.hpp"
#include "linewright/simulation/run_setup.hpp"
#include "linewright/simulation/state.hpp"

namespace linewright {

struct CompiledLine;

/// A crew slot that a running task still has to fill, and that can be filled now.
struct PendingJoin {
  std::size_t execution = 0;  ///< index into SimulationState::executions
  std::size_t slot = 0;
};

/// The deterministic discrete-event simulator of one line (docs/formats/scenario.md, Semantics).
/// Holds no run: the state is the caller's, so one Simulator serves any number of runs and threads
/// at once. Event by event, in whole ticks; no allocation once a state has been reset for the line
/// (but for ways that the line's WayFinder has not been asked for before).
class Simulator {
 public:
  explicit Simulator(std::shared_ptr<const LineModel> line);
  ~Simulator();
  Simulator(Simulator&&) noexcept;
  Simulator& operator=(Simulator&&) noexcept;
  Simulator(const Simulator&) = delete;
  Simulator& operator=(const Simulator&) = delete;

  [[nodiscard]] const LineModel& line() const { return *line_; }

  /// Puts the state at tick 0 of a new run. With a log, records the setup.
  void reset(SimulationState& state, const RunSetup& setup, EventLog* log = nullptr) const;

  /// Goes on until a decision is due (kDecision), a late joiner can be bound (kJoin) or the run has
  /// ended. Calling it when one of these holds changes nothing.
  RunStatus advance(SimulationState& state, EventLog* log = nullptr) const;

  /// Goes on to the end of `tick` without deciding anything (kRunning), to a tick after which a
  /// late joiner can be bound (kJoin), or to the end of the run.
  RunStatus advance_to(SimulationState& state, Tick tick, EventLog* log = nullptr) const;

  /// Takes the decision at tick now + 1 and simulates that tick. Returns false, and changes
  /// nothing, when `explain_refusal` has something to say about the assignment.
  bool assign(SimulationState& state, const Assignment& assignment, EventLog* log = nullptr) const;

  /// Whether `assign` would take it: explain_refusal without the words.
  [[nodiscard]] bool can_assign(const SimulationState& state, const Assignment& assignment) const;

  /// The decision to wait: goes on to the end of the next tick in which something happens. Returns
  /// false, and changes nothing, when nothing is under way that could happen.
  bool wait(SimulationState& state, EventLog* log = nullptr) const;

  /// A late joiner that can be bound before the next decision: the oldest execution first.
  [[nodiscard]] std::optional<PendingJoin> pending_join(const SimulationState& state) const;

  /// Binds a free worker of the slot's kind at tick now + 1. Returns false, and changes nothing,
  /// when the worker does not fit or nothing is pending.
  bool join(SimulationState& state, PendingJoin pending, WorkerId worker,
            EventLog* log = nullptr) const;

  /// Why the assignment cannot be made now, in words; empty when it can.
  [[nodiscard]] std::string explain_refusal(const SimulationState& state,
                                            const Assignment& assignment) const;

  /// Why the task is not selectable now, in words (the first condition that fails); empty when it
  /// is.
  [[nodiscard]] std::string explain_unselectable(const SimulationState& state, TaskId task) const;

  /// Whether the carrier is one that the slot may be given now.
  [[nodiscard]] bool carrier_fits(const SimulationState& state, const CrewSlot& slot,
                                  CarrierId carrier) const;

  /// The value of a variable of the line now.
  [[nodiscard]] std::int32_t value(const SimulationState& state, Variable variable) const;

  /// Where the variable stands in SimulationState::values, for those who read it often.
  [[nodiscard]] std::size_t index_of(Variable variable) const;

  /// Appends every value that a condition or a rule can read and that can matter for the future:
  /// the marking, machines, who is free; counts of what has been done only where a condition reads
  /// them.
  void append_marking(const SimulationState& state, std::vector<std::int32_t>& values) const;

  /// Share of the order that is finished, 0 ... 1.
  [[nodiscard]] double progress(const SimulationState& state) const;

  /// Where the worker is at the end of tick `at` (state.now or later, as far as its way is known).
  [[nodiscard]] Pose2 worker_pose(const SimulationState& state, WorkerId worker, Tick at) const;

  /// The way to the station. Of a free worker: exactly what it would need if a task of tick now + 1
  /// sent it there at once (min_leg_ticks apart), from wherever it is then; of a busy one: the rest
  /// of its way, then the line's own. Ticks -1: there is none (with closed zones: none now).
  [[nodiscard]] Leg route_from_worker(const SimulationState& state, WorkerId worker,
                                      StationId to) const;

  /// The station with a pose for its kind that is nearest, in a straight line, to where the worker
  /// is at the end of tick state.now; the one where it stands, if it stands at one. Ties: the
  /// first.
  [[nodiscard]] StationId snapped_station(const SimulationState& state, WorkerId worker) const;

  /// Whether it stands at its station (WorkerState::station), not somewhere on the floor.
  [[nodiscard]] bool stands_at_station(const SimulationState& state, WorkerId worker) const;

  /// The ways between stations for workers of the kind that set out at tick now + 1: those of the
  /// line, or, while zones are closed, around these.
  [[nodiscard]] const TravelTable& travel(const SimulationState& state, WorkerKindId kind) const;

 private:
  std::shared_ptr<const LineModel> line_;
  std::unique_ptr<const CompiledLine> compiled_;
};

}  // namespace linewright
