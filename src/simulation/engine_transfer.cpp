#include <variant>

#include "engine.hpp"

namespace linewright {
namespace {

/// The task's reservation of this place that is still held; -1: none.
int reservation_for(const Task& task, std::uint32_t held, const Endpoint& endpoint, bool room) {
  if (!endpoint.place) return -1;
  for (std::size_t r = 0; r < task.reserves.size(); ++r) {
    const Reservation& reservation = task.reserves[r];
    if (((held >> r) & 1U) != 0 && reservation.room == room &&
        reservation.place == *endpoint.place) {
      return static_cast<int>(r);
    }
  }
  return -1;
}

std::size_t at(std::int16_t id) { return static_cast<std::size_t>(id); }

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
  const std::int16_t material = from >= 0
                                    ? state_.carriers[at(from)].material
                                    : compiled_.place_material[transfer.source.place->index()];
  if (from >= 0) {
    ++state_.carriers[at(from)].leaving;
    if (state_.carriers[at(from)].berth >= 0) refresh_berth(state_.carriers[at(from)].berth);
  } else if (const int r = reservation_for(task, execution.reserved, transfer.source, false);
             r >= 0) {
    execution.reserved &= ~(1U << static_cast<unsigned>(r));
  } else {
    add(ValueLayout::place(transfer.source.place->value, ValueLayout::kAvailable), -1);
  }
  if (into >= 0) {
    ++state_.carriers[at(into)].coming;
    state_.carriers[at(into)].material = material;
    if (state_.carriers[at(into)].berth >= 0) refresh_berth(state_.carriers[at(into)].berth);
  } else if (const int r = reservation_for(task, execution.reserved, transfer.destination, true);
             r >= 0) {
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
    if (carrier.berth >= 0) {
      refresh_berth(carrier.berth);
      milestones(compiled_.place_milestones[at(carrier.berth)]);
    }
  } else {
    const std::int32_t place = transfer.destination.place->value;
    add(ValueLayout::place(place, ValueLayout::kCount), 1);
    add(ValueLayout::place(place, ValueLayout::kAvailable), 1);
    milestones(compiled_.place_milestones[static_cast<std::size_t>(place)]);
  }
}

}  // namespace linewright
