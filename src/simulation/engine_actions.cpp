#include <algorithm>
#include <variant>

#include "engine.hpp"

namespace linewright {
namespace {

std::uint8_t slot_bit(std::size_t slot) { return static_cast<std::uint8_t>(1U << slot); }

std::size_t at(std::int16_t id) { return static_cast<std::size_t>(id); }

}  // namespace

void Engine::end_action(std::int16_t id) {
  // Begins the next action of the sequence; begin_action may end it at once and come back here.
  WorkerState& worker = state_.workers[at(id)];
  const std::int16_t execution_id = worker.execution;
  const Execution& execution = state_.executions[at(execution_id)];
  const auto step = at(execution.step);
  const std::int16_t sequence =
      compiled_.tasks[at(execution.task)].sequence_of[step][at(worker.slot)];
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
  } else if (worker.arrive > state_.now || worker.no_way) {
    worker.phase = WorkerState::Phase::kArriving;
    if (!worker.no_way) schedule(worker.arrive, worker_order(id));
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
  worker.phase = WorkerState::Phase::kMain;
  set_out(id, to, state_.now + action.before);
  if (worker.no_way) return;
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
    worker.phase =
        WorkerState::Phase::kWaiting;  // tried with the other waiting actions of this tick
    state_.waiting.push_back(id);
  } else if (const auto* park_action = std::get_if<ParkAction>(&action.what)) {
    park(id, *park_action);
    end_main(id);
  } else {
    release(id);
  }
}

bool Engine::start_waiting_actions() {
  if (state_.waiting.empty()) return false;
  // In order of the executions' serials, then of the workers.
  std::sort(state_.waiting.begin(), state_.waiting.end(), [&](std::int16_t a, std::int16_t b) {
    const auto serial = [&](std::int16_t w) {
      return state_.executions[at(state_.workers[at(w)].execution)].serial;
    };
    return serial(a) != serial(b) ? serial(a) < serial(b) : a < b;
  });
  bool any = false;
  for (std::size_t i = 0; i < state_.waiting.size();) {
    const std::int16_t id = state_.waiting[i];
    if (!start_waiting(id)) {
      ++i;
      continue;
    }
    any = true;
    state_.workers[at(id)].phase = WorkerState::Phase::kMain;
    state_.waiting.erase(state_.waiting.begin() + static_cast<std::ptrdiff_t>(i));
    i = 0;  // an earlier one may have become possible
  }
  return any;
}

bool Engine::start_waiting(std::int16_t id) {
  WorkerState& worker = state_.workers[at(id)];
  const auto* operate = std::get_if<OperateAction>(&action_of(worker).what);
  if (operate == nullptr) return begin_item(id);
  if (!compiled_.operations[operate->operation.index()].enabled.holds(state_.values)) return false;
  worker.work_since = state_.now;
  start_operation(operate->operation.value, id);
  return true;
}

void Engine::end_phase(std::int16_t id) {
  WorkerState& worker = state_.workers[at(id)];
  switch (worker.phase) {
    case WorkerState::Phase::kBefore:
      begin_main(id);
      break;
    case WorkerState::Phase::kAfter:
      end_action(id);
      break;
    case WorkerState::Phase::kMain:
      if (std::holds_alternative<TransferAction>(action_of(worker).what)) {
        end_item(id);
        begin_main(id);
      } else {
        end_main(id);
      }
      break;
    case WorkerState::Phase::kArriving:
      begin_action(id);
      break;
    case WorkerState::Phase::kNone:
    case WorkerState::Phase::kWaiting:
    case WorkerState::Phase::kNoWay:
      break;
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
  if (state_.carriers[at(carrier)].holder >= 0)
    put_down(carrier, state_.carriers[at(carrier)].holder);
  if (!action.berth) return;
  execution.gone |= slot_bit(action.carrier_slot);
  unbind_carrier(carrier);
}

void Engine::release(std::int16_t id) {
  const std::int16_t execution_id = state_.workers[at(id)].execution;
  Execution& execution = state_.executions[at(execution_id)];
  const std::size_t slot = at(state_.workers[at(id)].slot);
  execution.gone |= slot_bit(slot);
  execution.members[slot] =
      Assignment::kNobody;  // it may come back as a late joiner of another slot
  unbind_worker(id);
  note({.tick = state_.now, .type = LogEvent::Type::kRelease, .a = id, .b = execution.serial});
  end_sequence(execution_id);
}

}  // namespace linewright
