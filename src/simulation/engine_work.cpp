#include <algorithm>
#include <variant>

#include "engine.hpp"

namespace linewright {
namespace {

template <class... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};

std::uint8_t slot_bit(std::size_t slot) { return static_cast<std::uint8_t>(1U << slot); }

std::size_t at(std::int16_t id) { return static_cast<std::size_t>(id); }

}  // namespace

// --- binding -----------------------------------------------------------------------------------

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
                           reservation.room ? ValueLayout::kRoom : ValueLayout::kAvailable), -1);
  }
  for (const std::int32_t berth : compiled_.tasks[assignment.task.index()].park_berths) {
    set(compiled_.layout.berth(berth, ValueLayout::kBerthOpen), 0);
    if (line_.places[static_cast<std::size_t>(berth)].berth->occupied == BerthOccupied::kOnAssignment) {
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

// --- steps and sequences -------------------------------------------------------------------------

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
    for (const ActorSequence& sequence : step.sequences) {
      if (((execution.gone | execution.missing) & slot_bit(sequence.slot)) != 0) continue;
      begin_sequence(execution.members[sequence.slot]);
    }
    if (--execution.open_sequences > 0) return;
  }
}

const Action& Engine::action_of(const WorkerState& worker) const {
  const Execution& execution = state_.executions[at(worker.execution)];
  const auto step = at(execution.step);
  const std::int16_t sequence = compiled_.tasks[at(execution.task)].sequence_of[step][at(worker.slot)];
  return line_.tasks[at(execution.task)].steps[step].sequences[at(sequence)].actions[at(worker.action)];
}

void Engine::begin_sequence(std::int16_t id) {
  WorkerState& worker = state_.workers[at(id)];
  const Execution& execution = state_.executions[at(worker.execution)];
  worker.action = -1;
  // A late joiner may have nothing to do in the step that is under way.
  if (compiled_.tasks[at(execution.task)].sequence_of[at(execution.step)][at(worker.slot)] < 0) return;
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
  for (std::uint8_t bits = execution.missing; bits != 0; bits = static_cast<std::uint8_t>(bits & (bits - 1))) {
    --state_.missing;
  }
  for (std::size_t r = 0; r < task.reserves.size(); ++r) {
    if (((execution.reserved >> r) & 1U) == 0) continue;
    add(ValueLayout::place(task.reserves[r].place.value,
                           task.reserves[r].room ? ValueLayout::kRoom : ValueLayout::kAvailable), 1);
  }
  note({.tick = state_.now, .type = LogEvent::Type::kTaskEnd, .a = task_id, .b = execution.serial});
  execution.task = -1;
  add(compiled_.layout.task_running(task_id), -1);
  add(compiled_.layout.task_running(task_id) + 1, 1);
  milestones(compiled_.task_end_milestones[at(task_id)]);
}

// --- actions ---------------------------------------------------------------------------------------

void Engine::end_action(std::int16_t id) {
  // Begins the next action of the sequence; begin_action may end it at once and come back here.
  WorkerState& worker = state_.workers[at(id)];
  const std::int16_t execution_id = worker.execution;
  const Execution& execution = state_.executions[at(execution_id)];
  const auto step = at(execution.step);
  const std::int16_t sequence = compiled_.tasks[at(execution.task)].sequence_of[step][at(worker.slot)];
  const auto& actions = line_.tasks[at(execution.task)].steps[step].sequences[at(sequence)].actions;
  ++worker.action;
  if (at(worker.action) < actions.size()) {
    begin_action(id);
  } else {
    worker.phase = WorkerState::Phase::kNone;
    end_sequence(execution_id);
  }
}

void Engine::begin_action(std::int16_t id) {
  WorkerState& worker = state_.workers[at(id)];
  const Action& action = action_of(worker);
  worker.items = 0;
  if (const auto* go = std::get_if<GoAction>(&action.what)) {
    begin_going(id, static_cast<std::int16_t>(go->station.value));
  } else if (const auto* fetch = std::get_if<FetchAction>(&action.what)) {
    const Execution& execution = state_.executions[at(worker.execution)];
    begin_going(id, state_.carriers[at(execution.members[fetch->carrier_slot])].station);
  } else if (action.before > 0) {
    worker.phase = WorkerState::Phase::kBefore;
    schedule(state_.now + action.before, worker_order(id));
  } else {
    begin_main(id);
  }
}

void Engine::begin_going(std::int16_t id, std::int16_t to) {
  WorkerState& worker = state_.workers[at(id)];
  const Action& action = action_of(worker);
  const Leg& leg = line_.travel[at(worker.kind)].leg(StationId(std::int32_t{worker.station}),
                                                     StationId(std::int32_t{to}));
  const Tick travel = std::max(leg.ticks, line_.worker_kinds[at(worker.kind)].min_leg_ticks);
  worker.from = worker.station;
  worker.station = to;
  worker.depart = state_.now + action.before;
  worker.arrive = worker.depart + travel;
  worker.phase = WorkerState::Phase::kMain;
  worker.travel_ticks += leg.ticks > 0 ? travel : 0;
  worker.travel_mm += static_cast<std::int64_t>(leg.metres * 1000.0 + 0.5);
  note({.tick = state_.now,
        .type = LogEvent::Type::kGo,
        .a = id,
        .b = state_.executions[at(worker.execution)].serial,
        .c = worker.from,
        .d = to,
        .e = worker.depart,
        .until = worker.arrive});
  if (worker.arrive == state_.now) {
    end_main(id);
  } else {
    schedule(worker.arrive, worker_order(id));
  }
}

void Engine::begin_main(std::int16_t id) {
  WorkerState& worker = state_.workers[at(id)];
  worker.phase = WorkerState::Phase::kMain;
  const Action& action = action_of(worker);
  if (const auto* transfer = std::get_if<TransferAction>(&action.what)) {
    const bool all = transfer->repeat == TransferAction::kUntilBlocked;
    if (!all && worker.items == transfer->repeat) {
      end_main(id);
    } else if (!begin_item(id)) {
      if (all) {
        end_main(id);
      } else {
        worker.phase = WorkerState::Phase::kWaiting;
        state_.waiting.push_back(id);
      }
    }
  } else if (std::holds_alternative<OperateAction>(action.what)) {
    worker.phase = WorkerState::Phase::kWaiting;  // tried with the other waiting actions of this tick
    state_.waiting.push_back(id);
  } else if (const auto* park_action = std::get_if<ParkAction>(&action.what)) {
    park(id, *park_action);
    end_main(id);
  } else {
    release(id);
  }
}

void Engine::start_waiting_actions() {
  // In order of the executions' serials, then of the workers.
  std::sort(state_.waiting.begin(), state_.waiting.end(), [&](std::int16_t a, std::int16_t b) {
    const auto serial = [&](std::int16_t w) {
      return state_.executions[at(state_.workers[at(w)].execution)].serial;
    };
    return serial(a) != serial(b) ? serial(a) < serial(b) : a < b;
  });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < state_.waiting.size(); ++i) {
    const std::int16_t id = state_.waiting[i];
    WorkerState& worker = state_.workers[at(id)];
    const Action& action = action_of(worker);
    bool started = false;
    if (const auto* operate = std::get_if<OperateAction>(&action.what)) {
      started = compiled_.operations[operate->operation.index()].enabled.holds(state_.values);
      if (started) {
        worker.work_since = state_.now;
        start_operation(operate->operation.value, id);
      }
    } else {
      started = begin_item(id);
    }
    if (started) {
      worker.phase = WorkerState::Phase::kMain;
    } else {
      state_.waiting[kept++] = id;
    }
  }
  state_.waiting.resize(kept);
}

void Engine::end_phase(std::int16_t id) {
  WorkerState& worker = state_.workers[at(id)];
  switch (worker.phase) {
    case WorkerState::Phase::kBefore: begin_main(id); break;
    case WorkerState::Phase::kAfter: end_action(id); break;
    case WorkerState::Phase::kMain:
      if (std::holds_alternative<TransferAction>(action_of(worker).what)) {
        end_item(id);
        begin_main(id);
      } else {
        end_main(id);
      }
      break;
    case WorkerState::Phase::kNone:
    case WorkerState::Phase::kWaiting: break;
  }
}

void Engine::end_main(std::int16_t id) {
  WorkerState& worker = state_.workers[at(id)];
  const Action& action = action_of(worker);
  if (worker.carrier >= 0) state_.carriers[at(worker.carrier)].station = worker.station;
  if (const auto* fetch = std::get_if<FetchAction>(&action.what)) {
    pick_up(id, state_.executions[at(worker.execution)].members[fetch->carrier_slot]);
  } else if (std::holds_alternative<OperateAction>(action.what)) {
    worker.work_ticks += state_.now - worker.work_since;
  }
  if (action.after > 0) {
    worker.phase = WorkerState::Phase::kAfter;
    schedule(state_.now + action.after, worker_order(id));
  } else {
    end_action(id);
  }
}

void Engine::park(std::int16_t id, const ParkAction& action) {
  Execution& execution = state_.executions[at(state_.workers[at(id)].execution)];
  const std::int16_t carrier = execution.members[action.carrier_slot];
  if (action.berth) occupy_berth(action.berth->value, carrier);
  if (state_.carriers[at(carrier)].holder >= 0) put_down(carrier, state_.carriers[at(carrier)].holder);
  if (!action.berth) return;
  execution.gone |= slot_bit(action.carrier_slot);
  unbind_carrier(carrier);
}

void Engine::release(std::int16_t id) {
  const std::int16_t execution_id = state_.workers[at(id)].execution;
  Execution& execution = state_.executions[at(execution_id)];
  execution.gone |= slot_bit(at(state_.workers[at(id)].slot));
  unbind_worker(id);
  note({.tick = state_.now, .type = LogEvent::Type::kRelease, .a = id, .b = execution.serial});
  end_sequence(execution_id);
}

// --- transfers -------------------------------------------------------------------------------------

namespace {

/// The task's reservation of this place that is still held; -1: none.
int reservation_for(const Task& task, std::uint32_t held, const Endpoint& endpoint, bool room) {
  if (!endpoint.place) return -1;
  for (std::size_t r = 0; r < task.reserves.size(); ++r) {
    const Reservation& reservation = task.reserves[r];
    if (((held >> r) & 1U) != 0 && reservation.room == room && reservation.place == *endpoint.place) {
      return static_cast<int>(r);
    }
  }
  return -1;
}

}  // namespace

std::int16_t Engine::carrier_at(const Execution& execution, const Endpoint& endpoint) const {
  return endpoint.place ? carrier_in(endpoint.place->value) : execution.members[endpoint.slot];
}

bool Engine::item_possible(const Execution& execution, const TransferAction& transfer) const {
  const Task& task = line_.tasks[at(execution.task)];
  const std::int16_t from = carrier_at(execution, transfer.source);
  const std::int16_t into = carrier_at(execution, transfer.destination);
  std::int16_t material = -1;
  if (from >= 0) {
    const CarrierState& carrier = state_.carriers[at(from)];
    if (carrier.items - carrier.leaving <= 0) return false;
    material = carrier.material;
  } else {
    const std::int32_t place = transfer.source.place->value;
    if (reservation_for(task, execution.reserved, transfer.source, false) < 0 &&
        value(ValueLayout::place(place, ValueLayout::kAvailable)) <= 0) {
      return false;
    }
    material = compiled_.place_material[static_cast<std::size_t>(place)];
  }
  if (into >= 0) {
    const CarrierState& carrier = state_.carriers[at(into)];
    const auto capacity = line_.carrier_kinds[at(carrier.kind)].capacity;
    return carrier.items + carrier.coming < capacity &&
           (carrier.material < 0 || carrier.material == material);
  }
  const std::int32_t place = transfer.destination.place->value;
  return compiled_.place_material[static_cast<std::size_t>(place)] == material &&
         (reservation_for(task, execution.reserved, transfer.destination, true) >= 0 ||
          value(ValueLayout::place(place, ValueLayout::kRoom)) > 0);
}

bool Engine::begin_item(std::int16_t id) {
  WorkerState& worker = state_.workers[at(id)];
  Execution& execution = state_.executions[at(worker.execution)];
  const auto& transfer = std::get<TransferAction>(action_of(worker).what);
  if (!item_possible(execution, transfer)) return false;
  const Task& task = line_.tasks[at(execution.task)];
  const std::int16_t from = carrier_at(execution, transfer.source);
  const std::int16_t into = carrier_at(execution, transfer.destination);
  const std::int16_t material =
      from >= 0 ? state_.carriers[at(from)].material
                : compiled_.place_material[transfer.source.place->index()];
  if (from >= 0) {
    ++state_.carriers[at(from)].leaving;
    if (transfer.source.place) refresh_berth(transfer.source.place->value);
  } else if (const int r = reservation_for(task, execution.reserved, transfer.source, false); r >= 0) {
    execution.reserved &= ~(1U << static_cast<unsigned>(r));
  } else {
    add(ValueLayout::place(transfer.source.place->value, ValueLayout::kAvailable), -1);
  }
  if (into >= 0) {
    ++state_.carriers[at(into)].coming;
    state_.carriers[at(into)].material = material;
    if (transfer.destination.place) refresh_berth(transfer.destination.place->value);
  } else if (const int r = reservation_for(task, execution.reserved, transfer.destination, true); r >= 0) {
    execution.reserved &= ~(1U << static_cast<unsigned>(r));
  } else {
    add(ValueLayout::place(transfer.destination.place->value, ValueLayout::kRoom), -1);
  }
  worker.work_since = state_.now;
  schedule(state_.now + transfer.takes, worker_order(id));
  const auto code = [](const Endpoint& endpoint, std::int16_t carrier) {
    return endpoint.place ? endpoint.place->value : -1 - std::int32_t{carrier};
  };
  note({.tick = state_.now,
        .type = LogEvent::Type::kTransfer,
        .a = id,
        .b = execution.serial,
        .c = code(transfer.source, from),
        .d = code(transfer.destination, into),
        .until = state_.now + transfer.takes});
  return true;
}

void Engine::end_item(std::int16_t id) {
  WorkerState& worker = state_.workers[at(id)];
  const Execution& execution = state_.executions[at(worker.execution)];
  const auto& transfer = std::get<TransferAction>(action_of(worker).what);
  ++worker.items;
  worker.work_ticks += state_.now - worker.work_since;
  if (const std::int16_t from = carrier_at(execution, transfer.source); from >= 0) {
    CarrierState& carrier = state_.carriers[at(from)];
    --carrier.leaving;
    if (--carrier.items + carrier.coming == 0) carrier.material = -1;
    if (carrier.berth >= 0) refresh_berth(carrier.berth);
  } else {
    const std::int32_t place = transfer.source.place->value;
    add(ValueLayout::place(place, ValueLayout::kCount), -1);
    add(ValueLayout::place(place, ValueLayout::kRoom), 1);
  }
  if (const std::int16_t into = carrier_at(execution, transfer.destination); into >= 0) {
    CarrierState& carrier = state_.carriers[at(into)];
    --carrier.coming;
    ++carrier.items;
    if (carrier.berth >= 0) refresh_berth(carrier.berth);
  } else {
    const std::int32_t place = transfer.destination.place->value;
    add(ValueLayout::place(place, ValueLayout::kCount), 1);
    add(ValueLayout::place(place, ValueLayout::kAvailable), 1);
    milestones(compiled_.place_milestones[static_cast<std::size_t>(place)]);
  }
}

}  // namespace linewright
