#include "linewright/planning/episode.hpp"

#include "linewright/allocation/advance.hpp"

namespace linewright {

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
