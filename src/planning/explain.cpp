#include "linewright/planning/explain.hpp"

#include "linewright/allocation/advance.hpp"
#include "linewright/base/tick.hpp"

namespace linewright {
namespace {

constexpr std::size_t kLongestRollout = 20'000;

std::optional<Tick> estimate(const Simulator& simulator, SimulationState state, TaskId task,
                             Planner& base, Allocator& allocator) {
  base.reset(1);
  allocator.reset(1);
  const Tick horizon = state.horizon;
  simulator.assign(state, allocator.allocate(state, task));
  for (std::size_t step = 0; step < kLongestRollout; ++step) {
    if (advance_and_join(simulator, state, allocator) != RunStatus::kDecision) break;
    const Decision decision = base.decide(state, all_choices(simulator, state));
    if (decision.task) {
      simulator.assign(state, allocator.allocate(state, *decision.task));
    } else if (!simulator.wait(state)) {
      break;
    }
  }
  if (state.status != RunStatus::kFinished || state.now > horizon) return std::nullopt;
  return state.now;
}

/// Where the task first needs the member: its first way; a carrier's place for who fetches it.
std::optional<StationId> needed_at(const LineModel& line, const SimulationState& state,
                                   const Assignment& assignment, std::size_t slot) {
  for (const Step& step : line.tasks[assignment.task.index()].steps) {
    for (const ActorSequence& sequence : step.sequences) {
      if (sequence.slot != slot || sequence.actions.empty()) continue;
      const Action& first = sequence.actions[0];
      if (const auto* go = std::get_if<GoAction>(&first.what)) return go->station;
      if (const auto* fetch = std::get_if<FetchAction>(&first.what)) {
        const std::int16_t carrier = assignment.members[fetch->carrier_slot];
        if (carrier < 0) return std::nullopt;
        return StationId(std::int32_t{state.carriers[static_cast<std::size_t>(carrier)].station});
      }
      return std::nullopt;
    }
  }
  return std::nullopt;
}

DecisionExplanation::Member member_of(const Simulator& simulator, const SimulationState& state,
                                      const Assignment& assignment, std::size_t slot) {
  const CrewSlot& crew = simulator.line().tasks[assignment.task.index()].crew[slot];
  DecisionExplanation::Member member{
      crew.role, needed_at(simulator.line(), state, assignment, slot), {}};
  for (std::size_t w = 0; w < state.workers.size(); ++w) {
    const WorkerState& worker = state.workers[w];
    if (!worker.free() || worker.kind != crew.worker->value) continue;
    const Leg way = member.needed_at
                        ? simulator.route_from_worker(state, WorkerId(w), *member.needed_at)
                        : Leg{0, 0.0};
    member.candidates.push_back(
        {WorkerId(w), way, assignment.members[slot] == static_cast<std::int16_t>(w)});
  }
  return member;
}

}  // namespace

DecisionExplanation explain_decision(const Simulator& simulator, const SimulationState& state,
                                     const GuardedDecision& decision, Planner& base,
                                     Allocator& allocator) {
  DecisionExplanation explanation;
  explanation.tick = state.now + 1;
  explanation.assignment = decision.assignment;
  explanation.planned_end = decision.planned_end;
  const LineModel& line = simulator.line();
  for (std::size_t t = 0; t < line.tasks.size(); ++t) {
    const TaskId task(t);
    if (!state.is_selectable(task)) {
      explanation.unselectable.push_back({task, simulator.explain_unselectable(state, task)});
      continue;
    }
    const bool ruled_out = decision.masked.contains(task);
    explanation.alternatives.push_back(
        {task, ruled_out ? std::nullopt : estimate(simulator, state, task, base, allocator),
         ruled_out});
  }
  if (!decision.assignment) return explanation;
  const auto& crew = line.tasks[decision.assignment->task.index()].crew;
  for (std::size_t slot = 0; slot < crew.size(); ++slot) {
    if (crew[slot].worker)
      explanation.members.push_back(member_of(simulator, state, *decision.assignment, slot));
  }
  return explanation;
}

}  // namespace linewright
