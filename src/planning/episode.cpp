#include "linewright/planning/episode.hpp"

#include <stdexcept>

#include "linewright/allocation/advance.hpp"

namespace linewright {
namespace {

/// The decision, with who does it where it is not to wait.
Decision complete_decision(const SimulationState& state, const Choices& choices, Planner& planner,
                           Allocator& allocator) {
  Decision decision = planner.decide(state, choices);
  if (!decision.task) return {.planned_end = decision.planned_end};
  if (!choices.tasks.contains(*decision.task)) {
    throw std::logic_error("the planner chose a task that it may not choose");
  }
  if (!decision.assignment) decision.assignment = allocator.allocate(state, *decision.task);
  return decision;
}

/// Adds the time between its beginning and its end.
class Stopwatch {
 public:
  Stopwatch(const EpisodeOptions& options, std::int64_t& sum)
      : options_(options), sum_(sum), begun_(options.now_ns ? options.now_ns() : 0) {}
  ~Stopwatch() {
    if (options_.now_ns) sum_ += options_.now_ns() - begun_;
  }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  const EpisodeOptions& options_;
  std::int64_t& sum_;
  std::int64_t begun_;
};

Shield::Verdict judge(const Simulator& simulator, const SimulationState& state,
                      const Assignment& assignment, const EpisodeOptions& options) {
  SimulationState after = state;
  if (!simulator.assign(after, assignment))
    throw std::logic_error("the planner chose somebody who cannot do the task");
  return options.shield->judge(after);
}

bool waiting_is_safe(const Simulator& simulator, const SimulationState& state,
                     const EpisodeOptions& options) {
  SimulationState after = state;
  return simulator.wait(after) && options.shield->judge(after) == Shield::Verdict::kSafe;
}

}  // namespace

GuardedDecision guarded_decision(const Simulator& simulator, const SimulationState& state,
                                 Planner& planner, Allocator& allocator,
                                 const EpisodeOptions& options) {
  GuardedDecision decision;
  Choices choices = all_choices(simulator, state);
  std::optional<Assignment> unsure;
  std::int64_t planner_ns = 0;
  std::int64_t shield_ns = 0;
  while (!choices.tasks.empty()) {
    {
      const Stopwatch watch(options, planner_ns);
      const Decision made = complete_decision(state, choices, planner, allocator);
      decision.assignment = made.assignment;
      decision.planned_end = made.planned_end;
    }
    if (options.shield == nullptr || !decision.assignment) break;
    const Stopwatch watch(options, shield_ns);
    const Shield::Verdict verdict = judge(simulator, state, *decision.assignment, options);
    if (verdict == Shield::Verdict::kSafe) break;
    if (verdict == Shield::Verdict::kUnknown && !unsure) unsure = decision.assignment;
    choices.tasks.erase(decision.assignment->task);
    decision.masked.insert(decision.assignment->task);
    decision.assignment.reset();
    decision.planned_end.reset();
  }
  if (!decision.assignment && unsure && choices.tasks.empty()) {
    const Stopwatch watch(options, shield_ns);
    if (!waiting_is_safe(simulator, state, options)) {
      decision.assignment = unsure;
      decision.masked.erase(unsure->task);
    }
  }
  if (options.now_ns && options.decision_ns != nullptr) options.decision_ns->push_back(planner_ns);
  if (options.shield_ns != nullptr) *options.shield_ns += shield_ns;
  return decision;
}

RunStatus run_episode(const Simulator& simulator, SimulationState& state, const RunSetup& setup,
                      std::uint64_t seed, Planner& planner, Allocator& allocator,
                      const EpisodeOptions& options) {
  planner.reset(seed);
  allocator.reset(seed);
  if (options.shield != nullptr) options.shield->reset();
  simulator.reset(state, setup, options.log);
  while (advance_and_join(simulator, state, allocator, options.log) == RunStatus::kDecision) {
    if (options.cancel != nullptr && options.cancel->requested()) return RunStatus::kRunning;
    const GuardedDecision decision =
        guarded_decision(simulator, state, planner, allocator, options);
    if (options.observe) options.observe(state, decision);
    if (decision.assignment) {
      if (!simulator.assign(state, *decision.assignment, options.log)) {
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
