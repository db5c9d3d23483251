#pragma once

#include <cstdint>
#include <optional>

#include "compiled_line.hpp"
#include "linewright/simulation/assignment.hpp"
#include "linewright/simulation/event_log.hpp"
#include "linewright/simulation/pending_event.hpp"
#include "linewright/simulation/simulator.hpp"
#include "linewright/simulation/state.hpp"
#include "ways.hpp"

namespace linewright {

/// The zones that are closed once the zone events of `tick` have happened, none of an earlier tick
/// being due.
[[nodiscard]] ZoneSet closed_at(const SimulationState& state, Tick tick);

/// The oldest execution with a missing member of whose kind one is free.
[[nodiscard]] std::optional<PendingJoin> find_join(const CompiledLine& compiled,
                                                   const SimulationState& state);

/// The rules of the simulation, at work on one state. Lives on the stack of a Simulator call.
class Engine {
 public:
  Engine(const CompiledLine& compiled, SimulationState& state, EventLog* log)
      : compiled_(compiled), line_(compiled.line), state_(state), log_(log) {}

  void reset(const RunSetup& setup);
  RunStatus advance();
  RunStatus advance_to(Tick tick);
  void assign(const Assignment& assignment);
  bool wait();
  void join(PendingJoin pending, WorkerId worker);

 private:
  // engine.cpp: the clock
  void process_tick(Tick tick);
  [[nodiscard]] bool more_can_happen() const;
  void handle(const SimulationState::Event& event);
  bool start_waiting_actions();
  bool start_waiting(std::int16_t worker);
  bool start_operations();
  RunStatus end(RunStatus status, Tick tick);
  void schedule(Tick tick, std::uint32_t order, std::int32_t operator_worker = -1);
  void unschedule(std::uint32_t order);
  void refresh_selectable();
  [[nodiscard]] bool any_selectable() const;
  static std::uint32_t join_order(std::int16_t worker);
  static std::uint32_t worker_order(std::int16_t worker);
  static std::uint32_t operation_order(std::int32_t operation);
  static std::uint32_t recovery_order(std::int32_t operation);
  static std::uint32_t rest_order(std::int16_t worker);

  // engine_ways.cpp: ways that begin between stations, zones, resting
  void change_zones(Tick tick);
  void answer_zones(std::int16_t worker, ZoneSet before);
  void try_again(std::int16_t worker);
  void set_out(std::int16_t worker, std::int16_t to, Tick depart);
  void leave_way(std::int16_t worker);
  void follow(std::int16_t worker, const Departure& way, std::int16_t to, Tick depart, Tick least);
  void lose_way(std::int16_t worker, std::int16_t to, Tick depart);
  void schedule_arrival(std::int16_t worker);
  [[nodiscard]] std::int16_t goal_of(const WorkerState& worker) const;
  [[nodiscard]] std::int32_t serial_of(const WorkerState& worker) const;
  void go_to_rest(std::int16_t worker);
  void begin_waiting_to_rest(std::int16_t worker);
  void interrupt_rest(std::int16_t worker);

  // engine_net.cpp: tokens, machines, operations
  void set(std::int32_t variable, std::int32_t value);
  void add(std::int32_t variable, std::int32_t change) {
    set(variable, state_.values[static_cast<std::size_t>(variable)] + change);
  }
  [[nodiscard]] std::int32_t value(std::int32_t variable) const {
    return state_.values[static_cast<std::size_t>(variable)];
  }
  void start_operation(std::int32_t operation, std::int32_t worker);
  void end_operation(std::int32_t operation, std::int32_t worker);
  void end_recovery(std::int32_t operation);
  void take_machine(const MachineUse& use);
  void let_go(const MachineUse& use);
  void rest(const MachineUse& use, bool held);
  void leave_tokens(std::int32_t place, std::int32_t count);
  void reserve_room(std::int32_t place, std::int32_t count);
  [[nodiscard]] std::int16_t carrier_in(std::int32_t place) const;
  void arrive_tokens(std::int32_t place, std::int32_t count);
  void milestones(const std::vector<std::int32_t>& ids);
  void refresh_berth(std::int32_t place);
  void refresh_carriers(std::int16_t kind);
  void occupy_berth(std::int32_t place, std::int16_t carrier);
  void vacate_berth(std::int32_t place, std::int16_t carrier);

  // engine_tasks.cpp: crews, steps; engine_actions.cpp: what workers do; engine_transfer.cpp: items
  void bind_worker(std::int16_t worker, std::int16_t execution, std::size_t slot);
  void bind_carrier(std::int16_t carrier, std::int16_t execution);
  void unbind_worker(std::int16_t worker);
  void unbind_carrier(std::int16_t carrier);
  void begin_step(std::int16_t execution);
  void begin_joined(std::int16_t worker);
  void begin_sequence(std::int16_t worker);
  void begin_action(std::int16_t worker);
  void begin_main(std::int16_t worker);
  void begin_going(std::int16_t worker, std::int16_t to);
  bool begin_item(std::int16_t worker);
  void end_item(std::int16_t worker);
  void end_phase(std::int16_t worker);
  void end_main(std::int16_t worker);
  void end_action(std::int16_t worker);
  void end_sequence(std::int16_t execution);
  void end_task(std::int16_t execution);
  void park(std::int16_t worker, const ParkAction& action);
  void release(std::int16_t worker);
  void put_down(std::int16_t carrier, std::int16_t worker);
  void pick_up(std::int16_t worker, std::int16_t carrier);
  [[nodiscard]] const Action& action_of(const WorkerState& worker) const;
  [[nodiscard]] std::int16_t carrier_at(const Execution& execution, const Endpoint& endpoint) const;
  void occupy_early(std::int32_t berth, const Execution& execution);
  [[nodiscard]] bool item_possible(const Execution& execution,
                                   const TransferAction& transfer) const;

  void note(const LogEvent& event) {
    if (log_ != nullptr) log_->events.push_back(event);
  }

  const CompiledLine& compiled_;
  const LineModel& line_;
  SimulationState& state_;
  EventLog* log_;
};

}  // namespace linewright
