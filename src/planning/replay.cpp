#include "linewright/planning/replay.hpp"

#include <algorithm>

#include "linewright/allocation/advance.hpp"
#include "linewright/planning/episode.hpp"

namespace linewright {
namespace {

/// To the end of `tick`, binding late joiners on the way: the recorded ones where they can be had.
void advance_joining(const Simulator& simulator, SimulationState& state, Tick tick,
                     const std::vector<RecordedDecision>& decisions, Allocator& fallback,
                     EventLog* log) {
  while (simulator.advance_to(state, tick, log) == RunStatus::kJoin) {
    const auto pending = simulator.pending_join(state);
    const auto serial = static_cast<std::size_t>(state.executions[pending->execution].serial);
    const std::int16_t recorded = decisions[serial - 1].joiners[pending->slot];
    if (recorded >= 0 && simulator.join(state, *pending, WorkerId(std::int32_t{recorded}), log))
      continue;
    bind_joiner(simulator, state, fallback, log);
  }
}

Assignment complete(const SimulationState& state, const RecordedDecision& decision,
                    const Simulator& simulator, Allocator& fallback) {
  Assignment assignment(decision.task);
  assignment.members = decision.members;
  const auto& crew = simulator.line().tasks[decision.task.index()].crew;
  const bool all_named =
      std::all_of(assignment.members.begin(),
                  assignment.members.begin() + static_cast<std::ptrdiff_t>(crew.size()),
                  [](std::int16_t member) { return member >= 0; });
  if (all_named || !state.is_selectable(decision.task)) return assignment;
  const Assignment chosen = fallback.allocate(state, decision.task);
  for (std::size_t slot = 0; slot < crew.size(); ++slot) {
    if (assignment.members[slot] < 0) assignment.members[slot] = chosen.members[slot];
  }
  return assignment;
}

}  // namespace

ReplayResult replay(const Simulator& simulator, SimulationState& state, const RunSetup& setup,
                    const std::vector<RecordedDecision>& decisions, Allocator& fallback,
                    EventLog* log) {
  ReplayResult result;
  fallback.reset(0);
  simulator.reset(state, setup, log);
  for (const RecordedDecision& decision : decisions) {
    ReplayedDecision& played = result.decisions.emplace_back();
    played.recorded = decision.tick;
    advance_joining(simulator, state, decision.tick - 1, decisions, fallback, log);
    while (!state.ended()) {
      const Assignment assignment = complete(state, decision, simulator, fallback);
      const std::string refusal = simulator.explain_refusal(state, assignment);
      if (refusal.empty()) {
        simulator.assign(state, assignment, log);
        played.taken = state.now;
        break;
      }
      played.refusal = refusal;
      if (state.events.empty()) break;  // nothing will ever change
      advance_joining(simulator, state, state.events.back().tick(), decisions, fallback, log);
    }
    if (!played.taken) break;
  }
  advance_joining(simulator, state, state.horizon + 1, decisions, fallback, log);
  result.status = state.status;
  return result;
}

}  // namespace linewright
