#include <algorithm>
#include <variant>

#include "engine.hpp"

namespace linewright {
namespace {

std::size_t at(std::int16_t id) { return static_cast<std::size_t>(id); }

}  // namespace

std::int32_t Engine::serial_of(const WorkerState& worker) const {
  return worker.free() ? -1 : state_.executions[at(worker.execution)].serial;
}

std::int16_t Engine::goal_of(const WorkerState& worker) const {
  const Action& action = action_of(worker);
  if (const auto* go = std::get_if<GoAction>(&action.what)) {
    return static_cast<std::int16_t>(go->station.value);
  }
  const auto& fetch = std::get<FetchAction>(action.what);
  const Execution& execution = state_.executions[at(worker.execution)];
  return state_.carriers[at(execution.members[fetch.carrier_slot])].station;
}

/// To `to`, from wherever the worker is; where closed zones leave no way, it waits for one.
void Engine::set_out(std::int16_t id, std::int16_t to, Tick depart) {
  WorkerState& worker = state_.workers[at(id)];
  const StationId goal(std::int32_t{to});
  const Tick least = line_.worker_kinds[at(worker.kind)].min_leg_ticks;
  if (state_.closed == 0 && !worker.no_way && worker.arrive <= state_.now) {
    // Nearly always: it stands at a station, and the line's own table has the way.
    const StationId here(std::int32_t{worker.station});
    follow(id, {line_.travel[at(worker.kind)].leg(here, goal), {}, worker.station}, to, depart,
           least);
    return;
  }
  const Departure way = departure(line_, worker, goal, state_.now, state_.closed);
  if (way.leg.ticks < 0) return lose_way(id, to, depart);  // never without a way
  leave_way(id);
  follow(id, way, to, depart, least);
}

/// `least`: ticks that the way lasts at least.
void Engine::follow(std::int16_t id, const Departure& way, std::int16_t to, Tick depart,
                    Tick least) {
  WorkerState& worker = state_.workers[at(id)];
  const Tick travel = std::max(way.leg.ticks, least);
  if (worker.phase == WorkerState::Phase::kNoWay) worker.phase = WorkerState::Phase::kMain;
  worker.no_way = false;
  worker.from = way.from;
  worker.station = to;
  worker.course = way.course;
  worker.depart = depart;
  worker.arrive = depart + travel;
  worker.way_ticks = way.leg.ticks > 0 ? travel : 0;
  worker.way_mm = static_cast<std::int64_t>(way.leg.metres * 1000.0 + 0.5);
  worker.travel_ticks += worker.way_ticks;
  worker.travel_mm += worker.way_mm;
  if (worker.free()) worker.rest_ticks += worker.way_ticks;
  const bool from_station = !way.course.from_pose && !way.course.turns();
  note({.tick = state_.now,
        .type = from_station ? LogEvent::Type::kGo : LogEvent::Type::kReroute,
        .a = id,
        .b = serial_of(worker),
        .c = worker.from,
        .d = to,
        .e = worker.depart,
        .until = worker.arrive,
        .course = worker.course});
}

/// Takes what the worker has not gone of the way it is on out of the totals.
void Engine::leave_way(std::int16_t id) {
  WorkerState& worker = state_.workers[at(id)];
  if (worker.no_way || worker.arrive <= state_.now) return;
  const Tick left = worker.way_ticks == 0 ? 0 : worker.arrive - std::max(state_.now, worker.depart);
  const double share = share_left(line_, worker, state_.now);
  worker.travel_ticks -= left;
  worker.travel_mm -= static_cast<std::int64_t>(share * static_cast<double>(worker.way_mm) + 0.5);
  if (worker.free()) worker.rest_ticks -= left;
  if (!between_stations(worker, state_.now)) worker.station = worker.from;  // it has not left
}

/// It stops where it is and waits until there is a way to `to`.
void Engine::lose_way(std::int16_t id, std::int16_t to, Tick depart) {
  WorkerState& worker = state_.workers[at(id)];
  const bool between = between_stations(worker, state_.now);
  const Pose2 pose = pose_at(line_, worker, state_.now);
  leave_way(id);
  unschedule(worker_order(id));
  worker.course = {};
  if (between) {
    worker.course.origin = pose;
    worker.course.from_pose = true;
    worker.station = to;
  }
  worker.from = worker.station;
  worker.no_way = true;
  worker.depart = depart;
  worker.arrive = state_.now;
  worker.way_ticks = 0;
  worker.way_mm = 0;
  if (worker.phase == WorkerState::Phase::kMain) worker.phase = WorkerState::Phase::kNoWay;
  note({.tick = state_.now,
        .type = LogEvent::Type::kBlocked,
        .a = id,
        .d = to,
        .course = {.origin = pose}});
}

void Engine::schedule_arrival(std::int16_t id) {
  const WorkerState& worker = state_.workers[at(id)];
  const bool awaited =
      worker.phase == WorkerState::Phase::kMain || worker.phase == WorkerState::Phase::kArriving;
  if (worker.free() || !awaited) return;  // nothing begins when it arrives
  unschedule(worker_order(id));
  schedule(worker.arrive, worker_order(id));
}

// --- zones
// ------------------------------------------------------------------------------------------

/// Closes and opens the zones whose time has come, all at once, and lets every worker answer.
void Engine::change_zones(Tick tick) {
  if (line_.zones.empty()) return;
  const ZoneSet before = state_.closed;
  state_.closed = closed_at(state_, tick);
  while (!state_.events.empty() && state_.events.back().tick() == tick &&
         (state_.events.back().order() & ~kEventNumber) == kZoneEvent) {
    const std::uint32_t zone = state_.events.back().order() & kEventNumber;
    state_.events.pop_back();
    note({.tick = tick,
          .type = LogEvent::Type::kZone,
          .a = static_cast<std::int32_t>(zone),
          .b = static_cast<std::int32_t>((state_.closed >> zone) & 1U)});
  }
  if (state_.closed == before) return;
  for (std::size_t w = 0; w < state_.workers.size(); ++w) {
    answer_zones(static_cast<std::int16_t>(w), before);
  }
}

void Engine::answer_zones(std::int16_t id, ZoneSet before) {
  const WorkerState& worker = state_.workers[at(id)];
  if (worker.no_way) return try_again(id);
  if (worker.arrive <= state_.now || worker.way_mm == 0) return;
  const bool must = runs_into(line_, worker, state_.now, state_.closed & ~before);
  const bool may = (worker.course.planned_with & before & ~state_.closed) != 0;
  if (!must && !may) return;
  const std::int16_t to = worker.station;
  const Tick depart = std::max(state_.now, worker.depart);
  const Departure way =
      departure(line_, worker, StationId(std::int32_t{to}), state_.now, state_.closed);
  if (must && way.leg.ticks < 0) return lose_way(id, to, depart);
  // What is left of a way may be shorter than a whole one.
  const Tick least =
      between_stations(worker, state_.now) ? 0 : line_.worker_kinds[at(worker.kind)].min_leg_ticks;
  const bool sooner = way.leg.ticks >= 0 && std::max(way.leg.ticks, least) < worker.arrive - depart;
  if (!must && !sooner) return;
  leave_way(id);
  follow(id, way, to, depart, least);
  schedule_arrival(id);
}

void Engine::try_again(std::int16_t id) {
  const WorkerState& worker = state_.workers[at(id)];
  const bool between = worker.course.from_pose;
  if (!between && worker.free()) return go_to_rest(id);
  const std::int16_t to = between ? worker.station : goal_of(worker);
  const Departure way =
      departure(line_, worker, StationId(std::int32_t{to}), state_.now, state_.closed);
  if (way.leg.ticks < 0) return;
  const Tick least = between ? 0 : line_.worker_kinds[at(worker.kind)].min_leg_ticks;
  follow(id, way, to, std::max(state_.now, worker.depart), least);
  schedule_arrival(id);
}

// --- resting
// ----------------------------------------------------------------------------------------

void Engine::begin_waiting_to_rest(std::int16_t id) {
  WorkerState& worker = state_.workers[at(id)];
  const WorkerKind& kind = line_.worker_kinds[at(worker.kind)];
  if (kind.rest.empty()) return;
  if (worker.arrive > state_.now && worker.way_ticks > 0) {  // the task ended before it arrived
    worker.rest_ticks += worker.arrive - state_.now;
  }
  schedule(std::max(1, state_.now + kind.rest_after), rest_order(id));
}

/// A worker with a task does not leave to rest; what is left of its way there belongs to the task.
void Engine::interrupt_rest(std::int16_t id) {
  WorkerState& worker = state_.workers[at(id)];
  unschedule(rest_order(id));
  if (worker.arrive > state_.now && worker.way_ticks > 0) {
    worker.rest_ticks -= worker.arrive - state_.now;
  }
  if (worker.no_way && !worker.course.from_pose) worker.no_way = false;
}

/// To the nearest station where its kind rests, unless it stands at one or is on its way already.
void Engine::go_to_rest(std::int16_t id) {
  WorkerState& worker = state_.workers[at(id)];
  const WorkerKind& kind = line_.worker_kinds[at(worker.kind)];
  if (!worker.free() || worker.arrive > state_.now) return;
  if (worker.no_way && worker.course.from_pose) return;  // it had to stop on its way there
  const auto stands_at = [&](StationId station) { return station.value == worker.station; };
  if (std::any_of(kind.rest.begin(), kind.rest.end(), stands_at)) return;
  Departure nearest;
  std::int16_t to = -1;
  for (const StationId station : kind.rest) {
    const Departure way = departure(line_, worker, station, state_.now, state_.closed);
    if (way.leg.ticks < 0 || (to >= 0 && way.leg.ticks >= nearest.leg.ticks)) continue;
    nearest = way;
    to = static_cast<std::int16_t>(station.value);
  }
  if (to >= 0) return follow(id, nearest, to, state_.now, kind.min_leg_ticks);
  worker.course = {};
  worker.no_way = state_.closed != 0;  // tried again when a zone opens
}

}  // namespace linewright
