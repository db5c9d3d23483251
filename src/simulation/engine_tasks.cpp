#include <variant>

#include "engine.hpp"

namespace linewright {
namespace {

std::uint8_t slot_bit(std::size_t slot) { return static_cast<std::uint8_t>(1U << slot); }

std::size_t at(std::int16_t id) { return static_cast<std::size_t>(id); }

}  // namespace

void Engine::assign(const Assignment& assignment) {
  const Tick tick = state_.now + 1;
  const Task& task = line_.tasks[assignment.task.index()];
  std::int16_t id = 0;
  while (state_.executions[at(id)].task >= 0) ++id;  // selectable: an entry is unused
  Execution& execution = state_.executions[at(id)];
  execution = Execution{};
  execution.task = static_cast<std::int16_t>(assignment.task.value);
  execution.step = -1;
  execution.serial = ++state_.serials;
  execution.started = tick;
  execution.members = assignment.members;
  ++state_.decisions;
  state_.now = tick;
  change_zones(tick);
  note({.tick = tick,
        .type = LogEvent::Type::kDecision,
        .a = assignment.task.value,
        .b = execution.serial,
        .members = assignment.members});

  for (std::size_t slot = 0; slot < task.crew.size(); ++slot) {
    const std::int16_t member = assignment.members[slot];
    if (member < 0) {
      execution.missing |= slot_bit(slot);
      ++state_.missing;
    } else if (task.crew[slot].worker) {
      bind_worker(member, id, slot);
    } else {
      bind_carrier(member, id);
    }
  }
  for (std::size_t r = 0; r < task.reserves.size(); ++r) {
    const Reservation& reservation = task.reserves[r];
    execution.reserved |= 1U << r;
    add(ValueLayout::place(reservation.place.value,
                           reservation.room ? ValueLayout::kRoom : ValueLayout::kAvailable),
        -1);
  }
  for (const std::int32_t berth : compiled_.tasks[assignment.task.index()].park_berths) {
    set(compiled_.layout.berth(berth, ValueLayout::kBerthOpen), 0);
    if (line_.places[static_cast<std::size_t>(berth)].berth->occupied ==
        BerthOccupied::kOnAssignment) {
      occupy_early(berth, execution);
    }
  }
  add(compiled_.layout.task_running(assignment.task.value), 1);
  milestones(compiled_.task_start_milestones[assignment.task.index()]);
  begin_step(id);
  process_tick(tick);
}

void Engine::occupy_early(std::int32_t berth, const Execution& execution) {
  for (const Step& step : line_.tasks[at(execution.task)].steps) {
    for (const ActorSequence& sequence : step.sequences) {
      for (const Action& action : sequence.actions) {
        const auto* park = std::get_if<ParkAction>(&action.what);
        if (park == nullptr || !park->berth || park->berth->value != berth) continue;
        occupy_berth(berth, execution.members[park->carrier_slot]);
        note({.tick = state_.now,
              .type = LogEvent::Type::kBerth,
              .a = execution.members[park->carrier_slot],
              .b = execution.serial,
              .c = berth});
      }
    }
  }
}

std::optional<PendingJoin> find_join(const CompiledLine& compiled, const SimulationState& state) {
  if (state.missing == 0) return std::nullopt;
  std::optional<PendingJoin> found;
  std::int32_t oldest = 0;
  for (std::size_t e = 0; e < state.executions.size(); ++e) {
    const Execution& execution = state.executions[e];
    if (execution.task < 0 || execution.missing == 0) continue;
    if (found && oldest < execution.serial) continue;
    const auto& crew = compiled.line.tasks[at(execution.task)].crew;
    for (std::size_t slot = 0; slot < crew.size(); ++slot) {
      if ((execution.missing & slot_bit(slot)) == 0) continue;
      const std::int32_t free = compiled.layout.worker_free(crew[slot].worker->value);
      if (state.values[static_cast<std::size_t>(free)] == 0) continue;
      found = PendingJoin{e, slot};
      oldest = execution.serial;
      break;
    }
  }
  return found;
}

void Engine::join(PendingJoin pending, WorkerId worker) {
  Execution& execution = state_.executions[pending.execution];
  const auto member = static_cast<std::int16_t>(worker.value);
  execution.missing = static_cast<std::uint8_t>(execution.missing & ~slot_bit(pending.slot));
  execution.joining |= slot_bit(pending.slot);
  execution.members[pending.slot] = member;
  --state_.missing;
  ++state_.now;  // bound at the next tick ...
  bind_worker(member, static_cast<std::int16_t>(pending.execution), pending.slot);
  note({.tick = state_.now,
        .type = LogEvent::Type::kJoin,
        .a = member,
        .b = execution.serial,
        .c = static_cast<std::int32_t>(pending.slot)});
  --state_.now;  // ... of which nothing else has happened yet
  schedule(state_.now + 1, join_order(member));
  state_.status = RunStatus::kRunning;
  refresh_selectable();
}

void Engine::bind_worker(std::int16_t id, std::int16_t execution, std::size_t slot) {
  WorkerState& worker = state_.workers[at(id)];
  if (compiled_.has_side_events) interrupt_rest(id);
  worker.execution = execution;
  worker.slot = static_cast<std::int16_t>(slot);
  worker.action = -1;
  worker.phase = WorkerState::Phase::kNone;
  worker.since = state_.now;
  add(compiled_.layout.worker_free(worker.kind), -1);
}

void Engine::unbind_worker(std::int16_t id) {
  WorkerState& worker = state_.workers[at(id)];
  if (worker.carrier >= 0) put_down(worker.carrier, id);
  worker.execution = -1;
  worker.slot = -1;
  worker.phase = WorkerState::Phase::kNone;
  worker.assigned_ticks += state_.now - worker.since;
  worker.since = state_.now;
  begin_waiting_to_rest(id);
  add(compiled_.layout.worker_free(worker.kind), 1);
}

void Engine::bind_carrier(std::int16_t id, std::int16_t execution) {
  CarrierState& carrier = state_.carriers[at(id)];
  carrier.execution = execution;
  if (carrier.berth >= 0) vacate_berth(carrier.berth, id);
  refresh_carriers(carrier.kind);
}

void Engine::unbind_carrier(std::int16_t id) {
  CarrierState& carrier = state_.carriers[at(id)];
  carrier.execution = -1;
  if (carrier.berth >= 0) refresh_berth(carrier.berth);
  refresh_carriers(carrier.kind);
}

void Engine::pick_up(std::int16_t id, std::int16_t carrier_id) {
  WorkerState& worker = state_.workers[at(id)];
  CarrierState& carrier = state_.carriers[at(carrier_id)];
  if (carrier.holder == id) return;
  if (carrier.holder >= 0) state_.workers[at(carrier.holder)].carrier = -1;
  if (worker.carrier >= 0) put_down(worker.carrier, id);
  carrier.holder = id;
  worker.carrier = carrier_id;
  note({.tick = state_.now,
        .type = LogEvent::Type::kPickUp,
        .a = id,
        .b = state_.executions[at(worker.execution)].serial,
        .c = carrier_id});
}

void Engine::put_down(std::int16_t carrier_id, std::int16_t id) {
  CarrierState& carrier = state_.carriers[at(carrier_id)];
  carrier.holder = -1;
  state_.workers[at(id)].carrier = -1;
  const std::int16_t execution = state_.workers[at(id)].execution;
  note({.tick = state_.now,
        .type = LogEvent::Type::kPutDown,
        .a = id,
        .b = state_.executions[at(execution)].serial,
        .c = carrier_id,
        .d = carrier.berth,
        .e = carrier.station});
}

void Engine::begin_step(std::int16_t id) {
  // A step with nobody left in it ends at once, so this may run through several.
  while (true) {
    Execution& execution = state_.executions[at(id)];
    const Task& task = line_.tasks[at(execution.task)];
    ++execution.step;
    if (at(execution.step) == task.steps.size()) {
      end_task(id);
      return;
    }
    const Step& step = task.steps[at(execution.step)];
    execution.open_sequences = 1;  // held open until all have begun
    for (const ActorSequence& sequence : step.sequences) {
      if ((execution.gone & slot_bit(sequence.slot)) != 0) continue;
      ++execution.open_sequences;
    }
    const int unable = execution.gone | execution.missing | execution.joining;
    for (const ActorSequence& sequence : step.sequences) {
      if ((unable & slot_bit(sequence.slot)) != 0) continue;
      begin_sequence(execution.members[sequence.slot]);
    }
    if (--execution.open_sequences > 0) return;
  }
}

const Action& Engine::action_of(const WorkerState& worker) const {
  const Execution& execution = state_.executions[at(worker.execution)];
  const auto step = at(execution.step);
  const std::int16_t sequence =
      compiled_.tasks[at(execution.task)].sequence_of[step][at(worker.slot)];
  return line_.tasks[at(execution.task)].steps[step].sequences[at(sequence)].actions[at(
      worker.action)];
}

void Engine::begin_joined(std::int16_t id) {
  const WorkerState& worker = state_.workers[at(id)];
  if (worker.free()) return;  // another joiner's first sequence has ended the task in this tick
  Execution& execution = state_.executions[at(worker.execution)];
  const std::uint8_t bit = slot_bit(at(worker.slot));
  if ((execution.joining & bit) == 0) return;
  execution.joining = static_cast<std::uint8_t>(execution.joining & ~bit);
  // A late joiner may have nothing to do in the step that is under way.
  const auto& sequences = compiled_.tasks[at(execution.task)].sequence_of[at(execution.step)];
  if (sequences[at(worker.slot)] >= 0) begin_sequence(id);
}

void Engine::begin_sequence(std::int16_t id) {
  state_.workers[at(id)].action = -1;
  end_action(id);
}

void Engine::end_sequence(std::int16_t id) {
  if (--state_.executions[at(id)].open_sequences == 0) begin_step(id);
}

void Engine::end_task(std::int16_t id) {
  Execution& execution = state_.executions[at(id)];
  const std::int16_t task_id = execution.task;
  const Task& task = line_.tasks[at(task_id)];
  for (std::size_t slot = 0; slot < task.crew.size(); ++slot) {
    if (((execution.gone | execution.missing) & slot_bit(slot)) != 0) continue;
    if (task.crew[slot].worker) {
      unbind_worker(execution.members[slot]);
    } else {
      unbind_carrier(execution.members[slot]);
    }
  }
  for (std::uint8_t bits = execution.missing; bits != 0;
       bits = static_cast<std::uint8_t>(bits & (bits - 1))) {
    --state_.missing;
  }
  for (std::size_t r = 0; r < task.reserves.size(); ++r) {
    if (((execution.reserved >> r) & 1U) == 0) continue;
    add(ValueLayout::place(task.reserves[r].place.value,
                           task.reserves[r].room ? ValueLayout::kRoom : ValueLayout::kAvailable),
        1);
  }
  note({.tick = state_.now, .type = LogEvent::Type::kTaskEnd, .a = task_id, .b = execution.serial});
  execution.task = -1;
  add(compiled_.layout.task_running(task_id), -1);
  add(compiled_.layout.task_running(task_id) + 1, 1);
  milestones(compiled_.task_end_milestones[at(task_id)]);
}

}  // namespace linewright
