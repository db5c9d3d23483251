#include <algorithm>

#include "engine.hpp"

namespace linewright {

void Engine::set(std::int32_t variable, std::int32_t value) {
  const auto at = static_cast<std::size_t>(variable);
  if (state_.values[at] == value) return;
  state_.values[at] = value;
  for (std::size_t w = 0; w < compiled_.operation_words; ++w) {
    state_.dirty_operations[w] |= compiled_.operations_reading[at * compiled_.operation_words + w];
  }
  for (std::size_t w = 0; w < compiled_.task_words; ++w) {
    state_.dirty_tasks[w] |= compiled_.tasks_reading[at * compiled_.task_words + w];
  }
}

void Engine::take_machine(const MachineUse& use) {
  const ValueLayout& layout = compiled_.layout;
  set(layout.machine(use.machine.value, ValueLayout::kFree), 0);
  set(layout.machine(use.machine.value, ValueLayout::kWorking), 1);
  MachineState& machine = state_.machines[use.machine.index()];
  machine.taken = true;
  machine.taken_at = state_.now;
}

void Engine::rest(const MachineUse& use, bool held) {
  MachineState& machine = state_.machines[use.machine.index()];
  const std::optional<std::int32_t> stands = use.to ? use.to : use.from;
  if (stands) machine.position = static_cast<std::int16_t>(*stands);
  machine.rest_since = state_.now;
  const ValueLayout& layout = compiled_.layout;
  set(layout.machine(use.machine.value, ValueLayout::kHeld), held ? 1 : 0);
  set(layout.machine(use.machine.value, ValueLayout::kWorking), held ? 1 : 0);
}

void Engine::let_go(const MachineUse& use) {
  MachineState& machine = state_.machines[use.machine.index()];
  machine.taken = false;
  machine.busy_ticks += state_.now - machine.taken_at;
  set(compiled_.layout.machine(use.machine.value, ValueLayout::kFree), 1);
}

void Engine::start_operation(std::int32_t id, std::int32_t worker) {
  const Operation& operation = line_.operations[static_cast<std::size_t>(id)];
  Tick travel = 0;
  for (const auto* uses : {&operation.uses, &operation.claims, &operation.frees}) {
    for (const MachineUse& use : *uses) {
      if (!use.from) continue;
      const MachineState& machine = state_.machines[use.machine.index()];
      travel = std::max(travel, compiled_.travel(use.machine, *use.from, machine, state_.now));
    }
  }
  for (const TokenFlow& flow : operation.consumes) leave_tokens(flow.place.value, flow.count);
  for (const TokenFlow& flow : operation.produces) reserve_room(flow.place.value, flow.count);
  for (const MachineUse& use : operation.uses) take_machine(use);
  for (const MachineUse& use : operation.claims) take_machine(use);
  // A machine that an operation frees is no longer up for another one to free.
  for (const MachineUse& use : operation.frees) {
    set(compiled_.layout.machine(use.machine.value, ValueLayout::kHeld), 0);
  }
  add(compiled_.layout.operation_running(id), 1);
  const Tick until = state_.now + travel + operation.takes;
  schedule(until, operation_order(id), worker);
  note({.tick = state_.now,
        .type = LogEvent::Type::kOperationStart,
        .a = id,
        .b = worker,
        .until = until});
}

void Engine::end_operation(std::int32_t id, std::int32_t worker) {
  const Operation& operation = line_.operations[static_cast<std::size_t>(id)];
  note({.tick = state_.now, .type = LogEvent::Type::kOperationEnd, .a = id});
  for (const TokenFlow& flow : operation.produces) arrive_tokens(flow.place.value, flow.count);
  for (const MachineUse& use : operation.claims) rest(use, true);
  for (const MachineUse& use : operation.uses) rest(use, false);
  for (const MachineUse& use : operation.frees) rest(use, false);
  add(compiled_.layout.operation_running(id), -1);
  add(compiled_.layout.operation_running(id) + 1, 1);
  milestones(compiled_.operation_milestones[static_cast<std::size_t>(id)]);
  if (operation.recovery > 0) {
    schedule(state_.now + operation.recovery, recovery_order(id));
  } else {
    for (const MachineUse& use : operation.uses) let_go(use);
    for (const MachineUse& use : operation.frees) let_go(use);
  }
  if (worker >= 0) end_main(static_cast<std::int16_t>(worker));
}

void Engine::end_recovery(std::int32_t id) {
  const Operation& operation = line_.operations[static_cast<std::size_t>(id)];
  for (const MachineUse& use : operation.uses) let_go(use);
  for (const MachineUse& use : operation.frees) let_go(use);
  note({.tick = state_.now, .type = LogEvent::Type::kRecoveryEnd, .a = id});
}

void Engine::leave_tokens(std::int32_t place, std::int32_t count) {
  if (const std::int16_t standing = carrier_in(place); standing >= 0) {
    CarrierState& carrier = state_.carriers[static_cast<std::size_t>(standing)];
    carrier.items -= count;
    if (carrier.items + carrier.coming == 0) carrier.material = -1;
    refresh_berth(place);
    return;
  }
  add(ValueLayout::place(place, ValueLayout::kCount), -count);
  add(ValueLayout::place(place, ValueLayout::kAvailable), -count);
  add(ValueLayout::place(place, ValueLayout::kRoom), count);
}

void Engine::reserve_room(std::int32_t place, std::int32_t count) {
  if (const std::int16_t standing = carrier_in(place); standing >= 0) {
    CarrierState& carrier = state_.carriers[static_cast<std::size_t>(standing)];
    carrier.coming += count;
    carrier.material = compiled_.place_material[static_cast<std::size_t>(place)];
    refresh_berth(place);
    return;
  }
  add(ValueLayout::place(place, ValueLayout::kRoom), -count);
}

void Engine::arrive_tokens(std::int32_t place, std::int32_t count) {
  if (const std::int16_t standing = carrier_in(place); standing >= 0) {
    CarrierState& carrier = state_.carriers[static_cast<std::size_t>(standing)];
    carrier.coming -= count;
    carrier.items += count;
    refresh_berth(place);
  } else {
    add(ValueLayout::place(place, ValueLayout::kCount), count);
    add(ValueLayout::place(place, ValueLayout::kAvailable), count);
  }
  milestones(compiled_.place_milestones[static_cast<std::size_t>(place)]);
}

void Engine::milestones(const std::vector<std::int32_t>& ids) {
  if (log_ == nullptr) return;
  for (const std::int32_t id : ids) {
    note({.tick = state_.now, .type = LogEvent::Type::kMilestone, .a = id});
  }
}

std::int16_t Engine::carrier_in(std::int32_t place) const {
  if (!line_.places[static_cast<std::size_t>(place)].berth) return -1;
  for (std::size_t c = 0; c < state_.carriers.size(); ++c) {
    if (state_.carriers[c].berth == place) return static_cast<std::int16_t>(c);
  }
  return -1;
}

void Engine::refresh_berth(std::int32_t place) {
  const ValueLayout& layout = compiled_.layout;
  std::int32_t count = 0;
  std::int32_t available = 0;
  std::int32_t room = 0;
  std::int32_t occupied = 0;
  bool ready = false;
  if (const std::int16_t standing = carrier_in(place); standing >= 0) {
    const CarrierState& carrier = state_.carriers[static_cast<std::size_t>(standing)];
    const auto capacity = line_.carrier_kinds[static_cast<std::size_t>(carrier.kind)].capacity;
    const bool fits = carrier.material < 0 ||
                      carrier.material == compiled_.place_material[static_cast<std::size_t>(place)];
    occupied = 1;
    count = carrier.items;
    available = fits ? carrier.items - carrier.leaving : 0;
    room = fits ? capacity - carrier.items - carrier.coming : 0;
    ready = carrier.execution < 0 && carrier.coming == 0 && carrier.leaving == 0;
  }
  set(ValueLayout::place(place, ValueLayout::kCount), count);
  set(ValueLayout::place(place, ValueLayout::kAvailable), available);
  set(ValueLayout::place(place, ValueLayout::kRoom), room);
  set(ValueLayout::place(place, ValueLayout::kOccupied), occupied);
  set(layout.berth(place, ValueLayout::kBerthReady), ready ? 1 : 0);
}

void Engine::refresh_carriers(std::int16_t kind) {
  std::int32_t free = 0;
  std::int32_t empty = 0;
  for (const CarrierState& carrier : state_.carriers) {
    if (carrier.kind != kind || !carrier.free()) continue;
    ++free;
    if (carrier.items == 0) ++empty;
  }
  set(compiled_.layout.carrier(kind, ValueLayout::kFreeCarriers), free);
  set(compiled_.layout.carrier(kind, ValueLayout::kFreeEmptyCarriers), empty);
}

void Engine::occupy_berth(std::int32_t place, std::int16_t carrier) {
  state_.carriers[static_cast<std::size_t>(carrier)].berth = static_cast<std::int16_t>(place);
  set(compiled_.layout.berth(place, ValueLayout::kBerthOpen), 0);
  refresh_berth(place);
}

void Engine::vacate_berth(std::int32_t place, std::int16_t carrier) {
  state_.carriers[static_cast<std::size_t>(carrier)].berth = -1;
  set(compiled_.layout.berth(place, ValueLayout::kBerthOpen), 1);
  refresh_berth(place);
}

}  // namespace linewright
