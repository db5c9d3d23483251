#include "linewright/planning/explain.hpp"

#include <fmt/format.h>

#include <algorithm>

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

/// "human.0": numbered within its kind.
std::string worker_name(const LineModel& line, const SimulationState& state, std::size_t worker) {
  const std::int16_t kind = state.workers[worker].kind;
  std::size_t number = 0;
  for (std::size_t w = 0; w < worker; ++w) number += state.workers[w].kind == kind ? 1 : 0;
  return fmt::format("{}.{}", line.worker_kinds[static_cast<std::size_t>(kind)].name, number);
}

std::string carrier_name(const LineModel& line, const SimulationState& state, std::size_t carrier) {
  const std::int16_t kind = state.carriers[carrier].kind;
  std::size_t number = 0;
  for (std::size_t c = 0; c < carrier; ++c) number += state.carriers[c].kind == kind ? 1 : 0;
  return fmt::format("{}.{}", line.carrier_kinds[static_cast<std::size_t>(kind)].name, number);
}

std::string crew_text(const LineModel& line, const SimulationState& state,
                      const Assignment& assignment) {
  std::vector<std::string> names;
  const auto& crew = line.tasks[assignment.task.index()].crew;
  for (std::size_t slot = 0; slot < crew.size(); ++slot) {
    if (assignment.members[slot] < 0) {
      names.push_back(fmt::format("a {} later", crew[slot].role));
      continue;
    }
    const auto member = static_cast<std::size_t>(assignment.members[slot]);
    names.push_back(crew[slot].worker ? worker_name(line, state, member)
                                      : carrier_name(line, state, member));
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string alternatives_text(const LineModel& line, const DecisionExplanation& explanation) {
  std::string text;
  for (const auto& alternative : explanation.alternatives) {
    const bool chosen = explanation.assignment && explanation.assignment->task == alternative.task;
    text +=
        fmt::format("    {} {}: ", chosen ? "*" : " ", line.tasks[alternative.task.index()].name);
    if (alternative.ruled_out) {
      text += "ruled out: the order could not be finished after it\n";
    } else if (alternative.estimate) {
      text += fmt::format("the run would end at about {}\n", *alternative.estimate);
    } else {
      text += "the simple rule that estimates does not finish after it\n";
    }
  }
  return text;
}

std::string member_text(const LineModel& line, const SimulationState& state,
                        const DecisionExplanation::Member& member) {
  std::vector<std::string> ways;
  std::string chosen = "nobody yet";
  for (const auto& candidate : member.candidates) {
    const std::string name = worker_name(line, state, candidate.worker.index());
    if (candidate.chosen) chosen = name;
    if (!member.needed_at) continue;
    ways.push_back(candidate.way.ticks < 0
                       ? name + " has no way"
                       : fmt::format("{} {} ticks, {:.1f} m", name, candidate.way.ticks,
                                     candidate.way.metres));
  }
  std::string text = fmt::format("    {}: {}", member.role, chosen);
  if (member.candidates.size() == 1) text += ", the only free one";
  if (member.needed_at) {
    text += fmt::format("; to {}: {}", line.stations[member.needed_at->index()].name,
                        fmt::join(ways, "; "));
  }
  return text + "\n";
}

}  // namespace

DecisionExplanation explain_decision(const Simulator& simulator, const SimulationState& state,
                                     const GuardedDecision& decision, Planner& base,
                                     Allocator& allocator) {
  DecisionExplanation explanation;
  explanation.tick = state.now + 1;
  explanation.assignment = decision.assignment;
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

std::string explanation_text(const Simulator& simulator, const SimulationState& state,
                             const DecisionExplanation& explanation) {
  const LineModel& line = simulator.line();
  std::string text = fmt::format("tick {}: ", explanation.tick);
  text += explanation.assignment
              ? fmt::format("{} by {}\n", line.tasks[explanation.assignment->task.index()].name,
                            crew_text(line, state, *explanation.assignment))
              : "waits\n";
  text += "  could be chosen (* was):\n" + alternatives_text(line, explanation);
  if (!explanation.members.empty()) text += "  who:\n";
  for (const auto& member : explanation.members) text += member_text(line, state, member);
  if (!explanation.unselectable.empty()) text += "  could not be chosen:\n";
  for (const auto& task : explanation.unselectable)
    text += fmt::format("      {}: {}\n", line.tasks[task.task.index()].name, task.reason);
  return text;
}

}  // namespace linewright
