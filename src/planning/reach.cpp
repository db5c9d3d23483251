#include "reach.hpp"

#include <algorithm>

namespace linewright {
namespace {

std::size_t at(int id) { return static_cast<std::size_t>(id); }

}  // namespace

Reach::Reach(const Simulator& simulator)
    : simulator_(simulator), line_(simulator.line()), materials_(materials_of(line_)) {
  operated_.assign(line_.operations.size(), std::vector<bool>(line_.tasks.size(), false));
  add_operations();
  for (std::size_t t = 0; t < line_.tasks.size(); ++t) add_task(t);
}

int Reach::pool(int kind, int material) const {
  return static_cast<int>(line_.places.size() + at(kind) * materials_.names.size()) + material;
}

void Reach::add_operations() {
  const auto store = [&](PlaceId place) {
    const auto& berth = line_.places[place.index()].berth;
    return berth ? pool(berth->carrier.value, materials_.by_place[place.index()]) : place.value;
  };
  for (std::size_t o = 0; o < line_.operations.size(); ++o) {
    Flow& flow = flows_.emplace_back();
    flow.operation = static_cast<int>(o);
    for (const TokenFlow& taken : line_.operations[o].consumes)
      flow.takes.emplace_back(store(taken.place), taken.count);
    for (const TokenFlow& given : line_.operations[o].produces)
      flow.gives.emplace_back(store(given.place), given.count);
  }
}

void Reach::add_task(std::size_t t) {
  const Task& task = line_.tasks[t];
  for (const Step& step : task.steps) {
    for (const ActorSequence& sequence : step.sequences) {
      for (const Action& action : sequence.actions) {
        if (const auto* park = std::get_if<ParkAction>(&action.what); park && park->berth)
          parkings_.push_back({static_cast<int>(t), park->carrier_slot, park->berth->value});
        if (const auto* operate = std::get_if<OperateAction>(&action.what))
          operated_[operate->operation.index()][t] = true;
        if (const auto* transfer = std::get_if<TransferAction>(&action.what))
          add_transfer(static_cast<int>(t), task, *transfer);
      }
    }
  }
}

/// -1: a carrier with whatever material.
int Reach::store_of(const Task& task, const Endpoint& here, const Endpoint& there) const {
  if (here.place) {
    const auto& berth = line_.places[here.place->index()].berth;
    if (!berth) return here.place->value;
    return pool(berth->carrier.value, materials_.by_place[here.place->index()]);
  }
  if (!there.place) return -1;
  return pool(task.crew[here.slot].carrier->value, materials_.by_place[there.place->index()]);
}

void Reach::add_transfer(int t, const Task& task, const TransferAction& transfer) {
  Flow flow;
  flow.task = t;
  const int from = store_of(task, transfer.source, transfer.destination);
  const int into = store_of(task, transfer.destination, transfer.source);
  if (from >= 0) flow.takes.emplace_back(from, 1);
  if (into >= 0) {
    flow.gives.emplace_back(into, 1);
  } else {  // from carrier to carrier: taken as a source of everything
    const int kind = task.crew[transfer.destination.slot].carrier->value;
    for (std::size_t m = 0; m < materials_.names.size(); ++m)
      flow.gives.emplace_back(pool(kind, static_cast<int>(m)), 1);
  }
  flows_.push_back(std::move(flow));
}

std::optional<int> Reach::parked_in(std::size_t task, std::size_t slot) const {
  for (const Parking& parking : parkings_) {
    if (at(parking.task) == task && parking.slot == slot) return parking.berth;
  }
  return std::nullopt;
}

void Reach::fill_limits(std::int32_t order) {
  if (order == limits_order_) return;
  limits_order_ = order;
  task_limits_.clear();
  operation_limits_.clear();
  for (const Task& task : line_.tasks) task_limits_.push_back(lower_limits(task.when, order));
  for (const Operation& operation : line_.operations)
    operation_limits_.push_back(lower_limits(operation.when, order));
  done_limits_ = lower_limits(line_.order.done_when, order);
  if (line_.order.done_when.always())
    done_limits_ = {{{VariableKind::kPlaceCount, line_.order.finished_in.value}, order}};
}

void Reach::begin(const SimulationState& state) {
  fill_limits(state.order);
  const std::size_t stores =
      line_.places.size() + line_.carrier_kinds.size() * materials_.names.size();
  lots_ = 4 * std::int64_t{state.order} + 1000;
  tokens_.assign(stores, 0);
  fired_.assign(flows_.size(), 0);
  possible_.assign(line_.tasks.size(), false);
  workers_.assign(line_.worker_kinds.size(), 0);
  const auto value = [&](VariableKind kind, std::size_t index) {
    return simulator_.value(state, {kind, static_cast<std::int32_t>(index)});
  };
  for (std::size_t p = 0; p < line_.places.size(); ++p) {
    if (!line_.places[p].berth) tokens_[p] = value(VariableKind::kPlaceCount, p);
  }
  for (std::size_t o = 0; o < line_.operations.size(); ++o) {
    const std::int32_t running = value(VariableKind::kOperationRunning, o);
    for (const auto& [store, count] : flows_[o].gives) tokens_[at(store)] += running * count;
  }
  for (std::size_t t = 0; t < line_.tasks.size(); ++t)
    possible_[t] = value(VariableKind::kTaskRunning, t) > 0;
  for (const WorkerState& worker : state.workers) ++workers_[at(worker.kind)];
  count_carriers(state);
}

void Reach::count_carriers(const SimulationState& state) {
  carrier_free_.assign(line_.carrier_kinds.size(), false);
  in_berth_.assign(line_.places.size(), false);
  for (std::size_t c = 0; c < state.carriers.size(); ++c) {
    const CarrierState& carrier = state.carriers[c];
    if (carrier.items > 0 && carrier.material >= 0)
      tokens_[at(pool(carrier.kind, carrier.material))] += carrier.items;
    if (carrier.berth >= 0) in_berth_[at(carrier.berth)] = true;
    if (carrier.execution < 0) {
      if (carrier.berth < 0) carrier_free_[at(carrier.kind)] = true;
      continue;
    }
    const Execution& execution = state.executions[at(carrier.execution)];
    const auto task = at(execution.task);
    for (std::size_t slot = 0; slot < line_.tasks[task].crew.size(); ++slot) {
      if (!line_.tasks[task].crew[slot].carrier ||
          execution.members[slot] != static_cast<std::int16_t>(c))
        continue;
      if (const auto berth = parked_in(task, slot)) {
        in_berth_[at(*berth)] = true;
      } else {
        carrier_free_[at(carrier.kind)] = true;
      }
    }
  }
}

bool Reach::limit_holds(Variable variable, std::int64_t value) const {
  const auto index = at(variable.index);
  switch (variable.kind) {
    case VariableKind::kPlaceCount:
    case VariableKind::kPlaceAvailable:
      // What is in a berth may be of any material: only a carrier is sure to be needed.
      if (line_.places[index].berth) return in_berth_[index];
      return tokens_[index] >= value;
    case VariableKind::kPlaceRoom:
    case VariableKind::kPlaceOccupied:
      return !line_.places[index].berth || in_berth_[index];
    default:
      return true;
  }
}

bool Reach::limits_hold(const std::vector<LowerLimit>& limits) const {
  return std::all_of(limits.begin(), limits.end(), [&](const LowerLimit& limit) {
    return limit_holds(limit.variable, limit.value);
  });
}

bool Reach::can_start(std::size_t t) {
  const Task& task = line_.tasks[t];
  needed_.assign(line_.worker_kinds.size(), 0);
  for (const CrewSlot& slot : task.crew) {
    if (slot.worker && !slot.join_late &&
        ++needed_[slot.worker->index()] > workers_[slot.worker->index()])
      return false;
    if (!slot.carrier) continue;
    const bool there = slot.wanted == CarrierWanted::kBerth ? in_berth_[slot.berth.index()]
                                                            : carrier_free_[slot.carrier->index()];
    if (!there) return false;
  }
  for (const Reservation& reservation : task.reserves) {
    if (!reservation.room && !limit_holds({VariableKind::kPlaceCount, reservation.place.value}, 1))
      return false;
  }
  return limits_hold(task_limits_[t]);
}

bool Reach::start_tasks() {
  bool more = false;
  for (std::size_t t = 0; t < line_.tasks.size(); ++t) {
    if (possible_[t] || !can_start(t)) continue;
    possible_[t] = true;
    more = true;
    for (std::size_t slot = 0; slot < line_.tasks[t].crew.size(); ++slot) {
      const CrewSlot& crew = line_.tasks[t].crew[slot];
      if (!crew.carrier) continue;
      if (const auto berth = parked_in(t, slot)) {
        in_berth_[at(*berth)] = true;
      } else {
        carrier_free_[crew.carrier->index()] = true;
      }
    }
  }
  return more;
}

bool Reach::can_fire(const Flow& flow) const {
  if (flow.task >= 0) return possible_[at(flow.task)];
  const Operation& operation = line_.operations[at(flow.operation)];
  if (operation.operated_by) {
    const auto& tasks = operated_[at(flow.operation)];
    bool operated = false;
    for (std::size_t t = 0; t < tasks.size(); ++t)
      operated = operated || (tasks[t] && possible_[t]);
    if (!operated) return false;
  }
  for (const TokenFlow& given : operation.produces) {
    if (line_.places[given.place.index()].berth && !in_berth_[given.place.index()]) return false;
  }
  return limits_hold(operation_limits_[at(flow.operation)]);
}

bool Reach::bring(int store, std::int64_t tokens) {
  const std::int64_t before = tokens_[at(store)];
  tokens_[at(store)] = std::min(lots_, before + tokens);
  return tokens_[at(store)] > before;
}

bool Reach::fire() {
  bool more = false;
  for (std::size_t f = 0; f < flows_.size(); ++f) {
    const Flow& flow = flows_[f];
    std::int64_t times = lots_;
    for (const auto& [store, count] : flow.takes) {
      const std::int64_t there = tokens_[at(store)];
      times = std::min(times, there >= lots_ ? lots_ : there / count);
    }
    if (times <= fired_[f] || !can_fire(flow)) continue;
    for (const auto& [store, count] : flow.gives)
      more = bring(store, times >= lots_ ? lots_ : (times - fired_[f]) * count) || more;
    fired_[f] = times;
  }
  return more;
}

bool Reach::may_finish(const SimulationState& state) {
  begin(state);
  for (bool more = true; more;) {
    more = start_tasks();
    more = fire() || more;
  }
  return std::all_of(done_limits_.begin(), done_limits_.end(), [&](const LowerLimit& need) {
    return std::int64_t{need.value} > lots_ || limit_holds(need.variable, need.value);
  });
}

}  // namespace linewright
