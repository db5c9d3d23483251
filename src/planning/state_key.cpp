#include "linewright/planning/state_key.hpp"

#include <algorithm>
#include <bit>

namespace linewright {
namespace {

std::uint64_t mix(std::uint64_t hash, std::uint64_t value, std::uint64_t multiplier) {
  hash ^= value;
  hash *= multiplier;
  return hash ^ (hash >> 29);
}

/// Longest time after which a machine's rest makes no difference any more.
Tick homing_memory(const Machine& machine) {
  if (!machine.homing) return 0;
  const auto& takes = machine.homing->takes;
  return machine.homing->holds + *std::max_element(takes.begin(), takes.end()) + 1;
}

/// Whether more than the tick of its arrival can matter of where the worker is: a free one can be
/// called from there, and zones can change any way.
bool way_matters(const LineModel& line, const WorkerState& worker, Tick now) {
  if (worker.no_way) return true;
  return worker.arrive > now && (worker.free() || !line.zones.empty());
}

void put_way(const WorkerState& worker, Tick now, std::vector<std::int32_t>& key) {
  const Course& course = worker.course;
  key.push_back((worker.no_way ? 1 : 0) | (course.from_pose ? 2 : 0));
  key.push_back(worker.from);
  key.push_back(worker.depart - now);
  key.push_back(worker.arrive - now);
  key.push_back(static_cast<std::int32_t>(course.planned_with));
  key.push_back(course.turn_from);
  key.push_back(course.turn_to);
  key.push_back(course.turn_ticks);
  for (const double number :
       {course.origin.x_m, course.origin.y_m, course.origin.heading_rad, course.turn_share}) {
    const auto bits = std::bit_cast<std::uint64_t>(number);
    key.push_back(static_cast<std::int32_t>(bits));
    key.push_back(static_cast<std::int32_t>(bits >> 32));
  }
}

}  // namespace

StateKey state_key(const Simulator& simulator, const SimulationState& state,
                   std::vector<std::int32_t>& key) {
  const LineModel& line = simulator.line();
  key.clear();
  const auto put = [&](std::int32_t value) { key.push_back(value); };
  simulator.append_marking(state, key);
  for (std::size_t m = 0; m < line.machines.size(); ++m) {
    put(state.machines[m].position);
    put(std::min(state.now - state.machines[m].rest_since, homing_memory(line.machines[m])));
  }
  // Executions in order of their serials, which is all that their serials are used for.
  if (!line.zones.empty()) put(static_cast<std::int32_t>(state.closed));
  std::vector<std::int16_t> order(state.executions.size(), -1);
  std::vector<std::size_t> running;
  for (std::size_t e = 0; e < state.executions.size(); ++e) {
    if (state.executions[e].task >= 0) running.push_back(e);
  }
  std::sort(running.begin(), running.end(), [&](std::size_t a, std::size_t b) {
    return state.executions[a].serial < state.executions[b].serial;
  });
  for (std::size_t rank = 0; rank < running.size(); ++rank) {
    const Execution& execution = state.executions[running[rank]];
    order[running[rank]] = static_cast<std::int16_t>(rank);
    put(execution.task);
    put(execution.step);
    put(execution.open_sequences);
    put(execution.missing | (execution.gone << 8) | (execution.joining << 16));
    put(static_cast<std::int32_t>(execution.reserved));
    for (std::size_t slot = 0;
         slot < line.tasks[static_cast<std::size_t>(execution.task)].crew.size(); ++slot) {
      put(execution.members[slot]);
    }
  }
  for (const WorkerState& worker : state.workers) {
    put(worker.station);
    if (way_matters(line, worker, state.now)) put_way(worker, state.now, key);
    put(worker.free() ? -1 : order[static_cast<std::size_t>(worker.execution)]);
    put(worker.carrier);
    if (worker.free()) continue;
    put(worker.action);
    put(static_cast<std::int32_t>(worker.phase));
    put(worker.items);
  }
  for (const CarrierState& carrier : state.carriers) {
    put(carrier.station);
    put(carrier.execution < 0 ? -1 : order[static_cast<std::size_t>(carrier.execution)]);
    put(carrier.berth);
    put(carrier.material);
    put(carrier.items);
    put(carrier.leaving);
    put(carrier.coming);
  }
  for (const SimulationState::Event& event : state.events) {
    put(event.tick() - state.now);
    put(static_cast<std::int32_t>(event.order()));
    put(event.operator_worker);
  }
  StateKey result{.high = 0x9e3779b97f4a7c15ULL, .low = 0xc2b2ae3d27d4eb4fULL};
  for (const std::int32_t value : key) {
    const auto word = static_cast<std::uint64_t>(static_cast<std::uint32_t>(value)) + 1;
    result.high = mix(result.high, word, 0xff51afd7ed558ccdULL);
    result.low = mix(result.low, word, 0xc4ceb9fe1a85ec53ULL);
  }
  return result;
}

}  // namespace linewright
