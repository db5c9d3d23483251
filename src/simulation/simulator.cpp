#include "linewright/simulation/simulator.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "compiled_line.hpp"
#include "engine.hpp"

namespace linewright {

Simulator::Simulator(std::shared_ptr<const LineModel> line)
    : line_(std::move(line)), compiled_(std::make_unique<CompiledLine>(*line_)) {}
Simulator::~Simulator() = default;
Simulator::Simulator(Simulator&&) noexcept = default;
Simulator& Simulator::operator=(Simulator&&) noexcept = default;

void Simulator::reset(SimulationState& state, const RunSetup& setup, EventLog* log) const {
  Engine(*compiled_, state, log).reset(setup);
}

RunStatus Simulator::advance(SimulationState& state, EventLog* log) const {
  return Engine(*compiled_, state, log).advance();
}

RunStatus Simulator::advance_to(SimulationState& state, Tick tick, EventLog* log) const {
  return Engine(*compiled_, state, log).advance_to(tick);
}

bool Simulator::assign(SimulationState& state, const Assignment& assignment, EventLog* log) const {
  if (!can_assign(state, assignment)) return false;
  Engine(*compiled_, state, log).assign(assignment);
  return true;
}

bool Simulator::wait(SimulationState& state, EventLog* log) const {
  return Engine(*compiled_, state, log).wait();
}

std::optional<PendingJoin> Simulator::pending_join(const SimulationState& state) const {
  return find_join(*compiled_, state);
}

bool Simulator::join(SimulationState& state, PendingJoin pending, WorkerId worker,
                     EventLog* log) const {
  if (state.ended() || pending.execution >= state.executions.size()) return false;
  const Execution& execution = state.executions[pending.execution];
  if (execution.task < 0 || pending.slot >= kMaxCrew) return false;
  if (((execution.missing >> pending.slot) & 1) == 0) return false;
  const CrewSlot& slot = line_->tasks[static_cast<std::size_t>(execution.task)].crew[pending.slot];
  if (worker.value < 0 || worker.index() >= state.workers.size()) return false;
  const WorkerState& candidate = state.workers[worker.index()];
  if (!candidate.free() || candidate.kind != slot.worker->value) return false;
  Engine(*compiled_, state, log).join(pending, worker);
  return true;
}

bool Simulator::carrier_fits(const SimulationState& state, const CrewSlot& slot,
                             CarrierId id) const {
  if (id.value < 0 || id.index() >= state.carriers.size()) return false;
  const CarrierState& carrier = state.carriers[id.index()];
  if (carrier.kind != slot.carrier->value || carrier.execution >= 0) return false;
  switch (slot.wanted) {
    case CarrierWanted::kEmpty:
      return carrier.berth < 0 && carrier.items == 0;
    case CarrierWanted::kAny:
      return carrier.berth < 0;
    case CarrierWanted::kBerth:
      return carrier.berth == slot.berth.value && carrier.coming == 0 && carrier.leaving == 0;
  }
  return false;
}

bool Simulator::can_assign(const SimulationState& state, const Assignment& assignment) const {
  if (state.ended() || state.now >= state.horizon) return false;
  if (assignment.task.value < 0 || assignment.task.index() >= line_->tasks.size()) return false;
  if (!state.is_selectable(assignment.task)) return false;
  const auto& crew = line_->tasks[assignment.task.index()].crew;
  for (std::size_t i = 0; i < crew.size(); ++i) {
    const std::int16_t member = assignment.members[i];
    if (crew[i].worker) {
      if (member < 0 && crew[i].join_late) continue;
      if (member < 0 || static_cast<std::size_t>(member) >= state.workers.size()) return false;
      const WorkerState& worker = state.workers[static_cast<std::size_t>(member)];
      if (!worker.free() || worker.kind != crew[i].worker->value) return false;
    } else if (!carrier_fits(state, crew[i], CarrierId(std::int32_t{member}))) {
      return false;
    }
    for (std::size_t j = 0; j < i; ++j) {
      if (crew[j].worker.has_value() == crew[i].worker.has_value() &&
          assignment.members[j] == member) {
        return false;
      }
    }
  }
  return true;
}

std::int32_t Simulator::value(const SimulationState& state, Variable variable) const {
  return state.values[index_of(variable)];
}

std::size_t Simulator::index_of(Variable variable) const {
  return static_cast<std::size_t>(compiled_->layout.index(variable));
}

void Simulator::append_marking(const SimulationState& state,
                               std::vector<std::int32_t>& values) const {
  for (std::size_t v = 0; v < state.values.size(); ++v) {
    if (compiled_->matters[v]) values.push_back(state.values[v]);
  }
}

double Simulator::progress(const SimulationState& state) const {
  const std::int32_t finished =
      value(state, {VariableKind::kPlaceCount, line_->order.finished_in.value});
  return state.order <= 0 ? 1.0 : std::min(1.0, static_cast<double>(finished) / state.order);
}

Pose2 Simulator::worker_pose(const SimulationState& state, WorkerId id, Tick at) const {
  return pose_at(*line_, state.workers[id.index()], at);
}

Leg Simulator::route_from_worker(const SimulationState& state, WorkerId id, StationId to) const {
  const WorkerState& worker = state.workers[id.index()];
  const auto kind = static_cast<std::size_t>(worker.kind);
  const StationId at(std::int32_t{worker.station});
  if (compiled_->has_side_events && worker.free()) {
    return departure(*line_, worker, to, state.now + 1, closed_at(state, state.now + 1)).leg;
  }
  Leg leg = line_->travel[kind].leg(at, to);
  if (worker.arrive <= state.now || leg.ticks < 0) return leg;
  // Under way: the rest of that way comes first.
  const Tick rest = worker.arrive - std::max(state.now, worker.depart);
  leg.ticks += worker.arrive - state.now;
  leg.metres += static_cast<double>(worker.way_mm) / 1000.0 * rest /
                std::max(1, worker.arrive - worker.depart);
  return leg;
}

bool Simulator::stands_at_station(const SimulationState& state, WorkerId id) const {
  const WorkerState& worker = state.workers[id.index()];
  return worker.arrive <= state.now && !between_stations(worker, state.now);
}

const TravelTable& Simulator::travel(const SimulationState& state, WorkerKindId kind) const {
  const ZoneSet closed = compiled_->has_side_events ? closed_at(state, state.now + 1) : ZoneSet{0};
  return closed == 0 ? line_->travel[kind.index()] : line_->ways->table(kind, closed);
}

StationId Simulator::snapped_station(const SimulationState& state, WorkerId id) const {
  const WorkerState& worker = state.workers[id.index()];
  const auto kind = static_cast<std::size_t>(worker.kind);
  StationId nearest(std::int32_t{worker.station});
  if (!between_stations(worker, state.now)) {
    return worker.arrive > state.now ? StationId(std::int32_t{worker.from}) : nearest;
  }
  const Point2 here = pose_at(*line_, worker, state.now).point();
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t s = 0; s < line_->stations.size(); ++s) {
    const auto& pose = line_->stations[s].poses[kind];
    if (!pose || distance_m(here, pose->point()) >= least) continue;
    least = distance_m(here, pose->point());
    nearest = StationId(s);
  }
  return nearest;
}

}  // namespace linewright
