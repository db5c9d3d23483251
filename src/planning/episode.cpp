#include "linewright/planning/episode.hpp"

#include <stdexcept>

namespace linewright {

void bind_joiner(const Simulator& simulator, SimulationState& state, Allocator& allocator,
                 EventLog* log) {
  const auto pending = simulator.pending_join(state);
  if (!pending || !simulator.join(state, *pending, allocator.join(state, *pending), log)) {
    throw std::logic_error("the allocator named nobody for a late joiner although one is free");
  }
}

RunStatus advance_and_join(const Simulator& simulator, SimulationState& state, Allocator& allocator,
                           EventLog* log) {
  while (simulator.advance(state, log) == RunStatus::kJoin) {
    bind_joiner(simulator, state, allocator, log);
  }
  return state.status;
}

RunStatus run_episode(const Simulator& simulator, SimulationState& state, const RunSetup& setup,
                      std::uint64_t seed, Planner& planner, Allocator& allocator, EventLog* log,
                      const CancelToken* cancel) {
  planner.reset(seed);
  allocator.reset(seed);
  simulator.reset(state, setup, log);
  while (advance_and_join(simulator, state, allocator, log) == RunStatus::kDecision) {
    if (cancel != nullptr && cancel->requested()) return RunStatus::kRunning;
    const std::optional<TaskId> task = planner.choose_task(state);
    if (task) {
      simulator.assign(state, allocator.allocate(state, *task), log);
    } else if (!simulator.wait(state, log)) {
      // Nothing is under way, so waiting would last for ever: that is the horizon.
      return simulator.advance_to(state, state.horizon + 1, log);
    }
  }
  return state.status;
}

}  // namespace linewright
