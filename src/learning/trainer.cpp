#include "linewright/learning/trainer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "dqn_trainer.hpp"
#include "linewright/base/diagnostic.hpp"
#include "linewright/evaluation/crews.hpp"
#include "linewright/evaluation/trials.hpp"
#include "ppo_trainer.hpp"

namespace linewright {

namespace {

/// Makespans of some runs that finished without a limit.
std::vector<Tick> trial_makespans(const Scenario& scenario, RunOptions crew, const char* planner) {
  constexpr std::size_t kTrials = 16;
  crew.horizon = kMaxTicks;
  const auto trials = run_trials(scenario, {.planner = planner},
                                 {.crews = {crew}, .trials = kTrials, .threads = 1});
  std::vector<Tick> makespans;
  for (const TrialResult& trial : trials[0]) {
    if (trial.status == RunStatus::kFinished) makespans.push_back(trial.makespan);
  }
  return makespans;
}

Tick scenario_horizon(const LineModel& line, const RunOptions& crew) {
  return line.horizon.ticks(crew.order.value_or(line.order.quantity));
}

/// `factor` times what the simplest rule takes: tight enough that a success means something.
std::optional<Tick> horizon_in_proportion(const Scenario& scenario, const RunOptions& crew,
                                          double factor) {
  if (factor == 0.0) return std::nullopt;
  const std::vector<Tick> makespans = trial_makespans(scenario, crew, "first");
  if (makespans.empty()) return std::nullopt;
  double sum = 0.0;
  for (const Tick makespan : makespans) sum += makespan;
  const double ticks = std::ceil(factor * sum / static_cast<double>(makespans.size()));
  return static_cast<Tick>(std::min<double>(ticks, scenario_horizon(scenario.line, crew)));
}

/// The shortest of some runs without a limit, by rule and at random; none finished: 0.
Tick shortest_trial(const Scenario& scenario, const RunOptions& crew) {
  Tick shortest = 0;
  for (const char* planner : {"first", "random"}) {
    for (const Tick makespan : trial_makespans(scenario, crew, planner)) {
      shortest = shortest == 0 ? makespan : std::min(shortest, makespan);
    }
  }
  return shortest;
}

/// Learning from failures alone leads nowhere: says so before hours are spent on it.
void refuse_short_horizons(const TrainingRun& run) {
  const LineModel& line = run.scenario->line;
  for (const RunOptions& crew : training_crews(*run.scenario, run.options.run)) {
    const Tick allowed = crew.horizon.value_or(scenario_horizon(line, crew));
    const Tick shortest = shortest_trial(*run.scenario, crew);
    // What is learned may be faster than what was tried, but hardly by half.
    if (shortest == 0 || shortest / 3 * 2 <= allowed) continue;
    std::string who;
    for (std::size_t k = 0; k < line.worker_kinds.size(); ++k) {
      who +=
          fmt::format("{}{} {}", k == 0 ? "" : ", ", line.worker_kinds[k].name, *crew.workers[k]);
    }
    throw ScenarioError(
        run.scenario->file,
        fmt::format("{} ticks are too short for the order with the crew {}: the fastest of 32 "
                    "trial runs took {} ticks",
                    allowed, who, shortest),
        "raise run.horizon (or the scenario's horizon) or order less (run.order)");
  }
}

}  // namespace

std::vector<RunOptions> training_crews(const Scenario& scenario, const RunSettings& settings) {
  const LineModel& line = scenario.line;
  std::vector<RunOptions> crews = all_crews(line);
  for (RunOptions& crew : crews) {
    std::vector<std::pair<std::string, std::int32_t>> counts;
    for (std::size_t k = 0; k < line.worker_kinds.size(); ++k) {
      counts.emplace_back(line.worker_kinds[k].name, *crew.workers[k]);
    }
    crew.order = settings.order;
    crew.horizon = horizon_for(settings, counts);
    if (!crew.horizon) {
      crew.horizon = horizon_in_proportion(scenario, crew, settings.horizon_factor);
    }
  }
  return crews;
}

TrainingResult train(const TrainingRun& run, const TrainingHooks& hooks) {
  check_training_options(run.options);
  refuse_short_horizons(run);
  return run.options.algorithm.kind == AlgorithmSettings::Kind::kPpo
             ? learning::train_ppo(run, hooks)
             : learning::train_dqn(run, hooks);
}

}  // namespace linewright
