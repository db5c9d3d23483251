#include "linewright/planning/episode.hpp"

#include <stdexcept>

#include "linewright/allocation/advance.hpp"

namespace linewright {
namespace {

/// The decision with who does it; no task: to wait.
std::optional<Assignment> complete_decision(const SimulationState& state, const Choices& choices,
                                            Planner& planner, Allocator& allocator) {
  const Decision decision = planner.decide(state, choices);
  if (!decision.task) return std::nullopt;
  if (!choices.tasks.contains(*decision.task)) {
    throw std::logic_error("the planner chose a task that it may not choose");
  }
  return decision.assignment ? *decision.assignment : allocator.allocate(state, *decision.task);
}

}  // namespace

RunStatus run_episode(const Simulator& simulator, SimulationState& state, const RunSetup& setup,
                      std::uint64_t seed, Planner& planner, Allocator& allocator,
                      const EpisodeOptions& options) {
  const bool timed = options.now_ns && options.decision_ns != nullptr;
  planner.reset(seed);
  allocator.reset(seed);
  simulator.reset(state, setup, options.log);
  while (advance_and_join(simulator, state, allocator, options.log) == RunStatus::kDecision) {
    if (options.cancel != nullptr && options.cancel->requested()) return RunStatus::kRunning;
    const std::int64_t begun = timed ? options.now_ns() : 0;
    const Choices choices = all_choices(simulator, state);
    const std::optional<Assignment> assignment =
        complete_decision(state, choices, planner, allocator);
    if (timed) options.decision_ns->push_back(options.now_ns() - begun);
    if (assignment) {
      if (!simulator.assign(state, *assignment, options.log)) {
        throw std::logic_error("the planner chose somebody who cannot do the task");
      }
    } else if (!simulator.wait(state, options.log)) {
      // Nothing is under way, so waiting would last for ever: that is the horizon.
      return simulator.advance_to(state, state.horizon + 1, options.log);
    }
  }
  return state.status;
}

}  // namespace linewright
