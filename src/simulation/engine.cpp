#include "engine.hpp"

#include <algorithm>
#include <bit>

namespace linewright {
namespace {

bool is_zone_event(const SimulationState::Event& event) { return kind_of(event) == kZoneEvent; }

}  // namespace

ZoneSet closed_at(const SimulationState& state, Tick tick) {
  ZoneSet closed = state.closed;
  for (auto event = state.events.rbegin(); event != state.events.rend(); ++event) {
    if (event->tick() > tick || !is_zone_event(*event)) break;
    closed ^= ZoneSet{1} << number_of(*event);
  }
  return closed;
}

std::uint32_t Engine::join_order(std::int16_t worker) {
  return kJoinEvent + static_cast<std::uint32_t>(worker);
}
std::uint32_t Engine::worker_order(std::int16_t worker) {
  return kWorkerEvent + static_cast<std::uint32_t>(worker);
}
std::uint32_t Engine::operation_order(std::int32_t operation) {
  return kOperationEvent + static_cast<std::uint32_t>(operation);
}
std::uint32_t Engine::recovery_order(std::int32_t operation) {
  return kRecoveryEvent + static_cast<std::uint32_t>(operation);
}
std::uint32_t Engine::rest_order(std::int16_t worker) {
  return kRestEvent + static_cast<std::uint32_t>(worker);
}

void Engine::reset(const RunSetup& setup) {
  state_.now = 0;
  state_.horizon = setup.horizon;
  state_.order = setup.order;
  state_.status = RunStatus::kRunning;
  state_.decisions = state_.serials = state_.missing = 0;
  state_.closed = 0;
  state_.values.assign(static_cast<std::size_t>(compiled_.layout.size), 0);
  state_.dirty_operations.assign(compiled_.operation_words, ~std::uint64_t{0});
  state_.dirty_tasks.assign(compiled_.task_words, ~std::uint64_t{0});
  state_.selectable.assign(compiled_.task_words, 0);
  state_.executions.assign(compiled_.most_executions, Execution{});
  state_.machines.clear();
  for (const Machine& machine : line_.machines) {
    state_.machines.push_back({.position = static_cast<std::int16_t>(machine.start)});
  }
  state_.events.clear();
  state_.waiting.clear();

  const ValueLayout& layout = compiled_.layout;
  set(layout.order, setup.order);
  for (std::size_t m = 0; m < line_.machines.size(); ++m) {
    set(layout.machine(static_cast<std::int32_t>(m), ValueLayout::kFree), 1);
  }
  for (std::size_t p = 0; p < line_.places.size(); ++p) {
    const auto id = static_cast<std::int32_t>(p);
    if (line_.places[p].berth) {
      set(layout.berth(id, ValueLayout::kBerthOpen), 1);
      continue;
    }
    // Beyond any amount a place may start with, and production stops before an int overflows.
    constexpr std::int32_t kUnlimited = 1'000'000'000;
    const auto tokens = static_cast<std::int32_t>(line_.places[p].initial.value(setup.order));
    set(ValueLayout::place(id, ValueLayout::kCount), tokens);
    set(ValueLayout::place(id, ValueLayout::kAvailable), tokens);
    set(ValueLayout::place(id, ValueLayout::kRoom),
        line_.places[p].capacity ? *line_.places[p].capacity - tokens : kUnlimited);
  }
  state_.workers.clear();
  for (std::size_t k = 0; k < setup.worker_start.size(); ++k) {
    for (const StationId station : setup.worker_start[k]) {
      WorkerState worker;
      worker.kind = static_cast<std::int16_t>(k);
      worker.station = worker.from = static_cast<std::int16_t>(station.value);
      state_.workers.push_back(worker);
    }
    set(layout.worker_free(static_cast<std::int32_t>(k)),
        static_cast<std::int32_t>(setup.worker_start[k].size()));
  }
  state_.carriers.clear();
  for (std::size_t k = 0; k < setup.carrier_start.size(); ++k) {
    for (const StationId station : setup.carrier_start[k]) {
      CarrierState carrier;
      carrier.kind = static_cast<std::int16_t>(k);
      carrier.station = static_cast<std::int16_t>(station.value);
      state_.carriers.push_back(carrier);
    }
    refresh_carriers(static_cast<std::int16_t>(k));
  }
  // As many events as can ever be pending, so that the steady state allocates nothing.
  state_.events.reserve(line_.operations.size() * 2 + state_.workers.size() * 2 +
                        setup.closures.size() * 2 + 8);
  state_.waiting.reserve(state_.workers.size());
  if (log_ != nullptr) {
    log_->setup = setup;
    log_->events.clear();
  }
  schedule(1, kStartOfRun);
  for (const Closure& closure : setup.closures) {
    for (const Tick tick : {closure.first, closure.open}) {
      schedule(tick, kZoneEvent + static_cast<std::uint32_t>(closure.zone));
    }
  }
  for (std::size_t w = 0; w < state_.workers.size(); ++w) {
    begin_waiting_to_rest(static_cast<std::int16_t>(w));
  }
  refresh_selectable();
}

void Engine::schedule(Tick tick, std::uint32_t order, std::int32_t operator_worker) {
  const std::uint64_t when = (static_cast<std::uint64_t>(tick) << 32) | order;
  auto& events = state_.events;
  // Few events are pending and most new ones lie late, that is near the front: shift from the back.
  std::size_t at = events.size();
  events.emplace_back();
  while (at > 0 && events[at - 1].when <= when) {
    events[at] = events[at - 1];
    --at;
  }
  events[at] = {.when = when, .operator_worker = operator_worker};
}

void Engine::unschedule(std::uint32_t order) {
  auto& events = state_.events;
  const auto found = std::find_if(events.begin(), events.end(),
                                  [&](const auto& event) { return event.order() == order; });
  if (found != events.end()) events.erase(found);
}

bool Engine::more_can_happen() const {
  if (!compiled_.has_side_events || state_.events.empty()) return !state_.events.empty();
  // Who rests changes nothing, and a zone that opens helps only who waits for a way.
  const bool waits = std::any_of(state_.workers.begin(), state_.workers.end(),
                                 [](const auto& w) { return w.no_way && !w.free(); });
  return std::any_of(state_.events.begin(), state_.events.end(), [&](const auto& event) {
    return is_zone_event(event) ? waits : event.order() < kRestEvent;
  });
}

RunStatus Engine::advance() {
  while (!state_.ended()) {
    if (state_.now < state_.horizon) {
      if (find_join(compiled_, state_)) return state_.status = RunStatus::kJoin;
      if (any_selectable()) return state_.status = RunStatus::kDecision;
    }
    if (!more_can_happen()) {
      // What could go on has run out of time; else more time would not help.
      const bool possible = any_selectable() || find_join(compiled_, state_);
      return end(possible ? RunStatus::kHorizon : RunStatus::kDeadlock, state_.now);
    }
    const Tick next = state_.events.back().tick();
    if (next > state_.horizon) return end(RunStatus::kHorizon, state_.horizon);
    process_tick(next);
  }
  return state_.status;
}

RunStatus Engine::advance_to(Tick tick) {
  while (!state_.ended()) {
    // Also at the very end of `tick`: a joiner is bound before the next decision.
    if (state_.now < state_.horizon && find_join(compiled_, state_)) {
      return state_.status = RunStatus::kJoin;
    }
    if (state_.now >= tick) break;
    const bool idle = state_.events.empty();
    if (!more_can_happen() && !any_selectable() && !find_join(compiled_, state_)) {
      return end(RunStatus::kDeadlock, state_.now);
    }
    const Tick next = idle ? tick : std::min(tick, state_.events.back().tick());
    if (next > state_.horizon) return end(RunStatus::kHorizon, state_.horizon);
    if (idle || state_.events.back().tick() > tick) {
      state_.now = tick;
    } else {
      process_tick(next);
    }
  }
  if (!state_.ended()) state_.status = RunStatus::kRunning;
  return state_.status;
}

bool Engine::wait() {
  if (state_.ended() || state_.events.empty()) return false;
  const Tick next = state_.events.back().tick();
  if (next > state_.horizon) {
    end(RunStatus::kHorizon, state_.horizon);
  } else {
    process_tick(next);
  }
  return true;
}

RunStatus Engine::end(RunStatus status, Tick tick) {
  state_.now = tick;
  state_.status = status;
  note({.tick = tick, .type = LogEvent::Type::kEnd, .a = static_cast<std::int32_t>(status)});
  return status;
}

void Engine::process_tick(Tick tick) {
  state_.now = tick;
  state_.status = RunStatus::kRunning;
  do {
    while (!state_.events.empty() && state_.events.back().tick() == tick) {
      const SimulationState::Event event = state_.events.back();
      if (is_zone_event(event)) {
        change_zones(tick);
        continue;
      }
      state_.events.pop_back();
      handle(event);
    }
    bool again = true;
    while (again) {  // what one starts may enable the other
      const bool waiting_started = start_waiting_actions();
      const bool operations_started = start_operations();
      again = !state_.waiting.empty() && (waiting_started || operations_started);
    }
  } while (!state_.events.empty() && state_.events.back().tick() == tick);
  refresh_selectable();
  const std::size_t done = compiled_.done_bit();
  if (((state_.selectable[done / 64] >> (done % 64)) & 1U) != 0) end(RunStatus::kFinished, tick);
}

void Engine::handle(const SimulationState::Event& event) {
  const auto number = static_cast<std::int32_t>(number_of(event));
  switch (kind_of(event)) {
    case kJoinEvent:
      begin_joined(static_cast<std::int16_t>(number));
      break;
    case kWorkerEvent:
      end_phase(static_cast<std::int16_t>(number));
      break;
    case kOperationEvent:
      end_operation(number, event.operator_worker);
      break;
    case kRecoveryEvent:
      end_recovery(number);
      break;
    case kRestEvent:
      go_to_rest(static_cast<std::int16_t>(number));
      break;
    default:
      break;  // kStartOfRun: only makes tick 1 happen
  }
}

bool Engine::start_operations() {
  bool started = false;
  // Always the first enabled operation of the file; after each start look again from the first.
  for (std::size_t word = 0; word < compiled_.operation_words;) {
    const std::uint64_t dirty = state_.dirty_operations[word];
    if (dirty == 0) {
      ++word;
      continue;
    }
    const auto bit = static_cast<std::size_t>(std::countr_zero(dirty));
    const std::size_t operation = word * 64 + bit;
    if (operation >= compiled_.operations.size()) {
      state_.dirty_operations[word] = 0;
      continue;
    }
    const CompiledOperation& candidate = compiled_.operations[operation];
    if (candidate.by_worker || !candidate.enabled.holds(state_.values)) {
      state_.dirty_operations[word] &= ~(std::uint64_t{1} << bit);
      continue;
    }
    start_operation(static_cast<std::int32_t>(operation), -1);
    started = true;
    word = 0;
  }
  return started;
}

void Engine::refresh_selectable() {
  for (std::size_t word = 0; word < compiled_.task_words; ++word) {
    std::uint64_t dirty = state_.dirty_tasks[word];
    state_.dirty_tasks[word] = 0;
    while (dirty != 0) {
      const auto bit = static_cast<std::size_t>(std::countr_zero(dirty));
      dirty &= dirty - 1;
      const std::size_t task = word * 64 + bit;
      if (task > compiled_.done_bit()) break;
      const CompiledCondition& condition =
          task == compiled_.done_bit() ? compiled_.done : compiled_.tasks[task].selectable;
      const std::uint64_t mask = std::uint64_t{1} << bit;
      if (condition.holds(state_.values)) {
        state_.selectable[word] |= mask;
      } else {
        state_.selectable[word] &= ~mask;
      }
    }
  }
}

bool Engine::any_selectable() const {
  const std::size_t done = compiled_.done_bit();
  for (std::size_t word = 0; word < compiled_.task_words; ++word) {
    std::uint64_t bits = state_.selectable[word];
    if (word == done / 64) bits &= ~(std::uint64_t{1} << (done % 64));
    if (bits != 0) return true;
  }
  return false;
}

}  // namespace linewright
