#include "linewright/learning/trainer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "dqn_trainer.hpp"
#include "linewright/base/diagnostic.hpp"
#include "linewright/evaluation/trials.hpp"
#include "ppo_trainer.hpp"

namespace linewright {

std::vector<RunOptions> training_crews(const LineModel& line, const RunSettings& settings) {
  std::vector<RunOptions> crews(1);
  for (const WorkerKind& kind : line.worker_kinds) {
    std::vector<RunOptions> more;
    for (const RunOptions& crew : crews) {
      for (std::int32_t count = kind.count.min; count <= kind.count.max; ++count) {
        more.push_back(crew);
        more.back().workers.emplace_back(count);
      }
    }
    crews = std::move(more);
  }
  for (RunOptions& crew : crews) {
    std::vector<std::pair<std::string, std::int32_t>> counts;
    for (std::size_t k = 0; k < line.worker_kinds.size(); ++k) {
      counts.emplace_back(line.worker_kinds[k].name, *crew.workers[k]);
    }
    crew.order = settings.order;
    crew.horizon = horizon_for(settings, counts);
  }
  return crews;
}

namespace {

/// The shortest of some runs without a limit, by rule and at random; none finished: 0.
Tick shortest_trial(const Scenario& scenario, RunOptions crew) {
  crew.horizon = kMaxTicks;
  Tick shortest = 0;
  for (const char* planner : {"first", "random"}) {
    const auto trials =
        run_trials(scenario, {.planner = planner}, {.crews = {crew}, .trials = 16, .threads = 1});
    for (const TrialResult& trial : trials[0]) {
      if (trial.status != RunStatus::kFinished) continue;
      shortest = shortest == 0 ? trial.makespan : std::min(shortest, trial.makespan);
    }
  }
  return shortest;
}

/// Learning from failures alone leads nowhere: says so before hours are spent on it.
void refuse_short_horizons(const TrainingRun& run) {
  const LineModel& line = run.scenario->line;
  for (const RunOptions& crew : training_crews(line, run.options.run)) {
    const Tick allowed =
        crew.horizon.value_or(line.horizon.ticks(crew.order.value_or(line.order.quantity)));
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

TrainingResult train(const TrainingRun& run, const TrainingHooks& hooks) {
  check_training_options(run.options);
  refuse_short_horizons(run);
  return run.options.algorithm.kind == AlgorithmSettings::Kind::kPpo
             ? learning::train_ppo(run, hooks)
             : learning::train_dqn(run, hooks);
}

}  // namespace linewright
