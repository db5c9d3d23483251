#include "linewright/experiments/cell.hpp"

#include <atomic>
#include <mutex>

#include "cell_runs.hpp"
#include "linewright/base/random.hpp"
#include "linewright/base/worker_pool.hpp"
#include "linewright/bounds/lower_bounds.hpp"
#include "linewright/evaluation/crews.hpp"

namespace linewright {
namespace experiments {

std::vector<RunOptions> crews_of(const ExperimentCell& cell, const Scenario& scenario) {
  std::vector<RunOptions> crews = all_crews(scenario.line);
  for (RunOptions& crew : crews) {
    crew.order = cell.order;
    crew.horizon = cell.horizon;
  }
  return crews;
}

RunSetup setup_of(const ExperimentCell& cell, const Scenario& scenario, const RunOptions& crew,
                  std::size_t trial) {
  return sample_setup(scenario.line, crew, trial_setup_seed(cell.seed, trial));
}

Tick bound_of(const Scenario& scenario, const RunSetup& setup, const CancelToken* cancel) {
  return lower_bounds(scenario.line, setup, {}, cancel).front().ticks;
}

}  // namespace experiments

namespace {

CellResult::Crew crew_of(const std::string& name, const std::vector<TrialResult>& trials) {
  CellResult::Crew crew{.name = name};
  for (const TrialResult& trial : trials) {
    crew.makespan.push_back(trial.makespan);
    crew.finished.push_back(trial.status == RunStatus::kFinished ? 1 : 0);
    crew.progress.push_back(trial.progress);
    crew.distance_m.push_back(static_cast<double>(trial.distance_mm) / 1000.0);
    crew.decisions.push_back(trial.decisions);
  }
  return crew;
}

std::optional<CellResult> play(const ExperimentCell& cell, const Scenario& scenario,
                               const std::function<std::int64_t()>& now_ns,
                               const TrialProgress& progress, const CancelToken* cancel) {
  const TrialPlan plan{.crews = experiments::crews_of(cell, scenario),
                       .trials = cell.trials,
                       .seed = cell.seed,
                       .now_ns = now_ns};
  const auto trials = run_trials(
      scenario, {.planner = cell.planner, .allocator = cell.allocator, .shield = cell.shield}, plan,
      progress, cancel);
  if (trials.size() < plan.crews.size()) return std::nullopt;
  CellResult result;
  for (std::size_t c = 0; c < trials.size(); ++c) {
    result.crews.push_back(crew_of(crew_name(scenario.line, plan.crews[c]), trials[c]));
  }
  return result;
}

/// One after the other on every core: some crews take a hundred times as long as others.
std::optional<CellResult> bounds(const ExperimentCell& cell, const Scenario& scenario,
                                 const TrialProgress& progress, const CancelToken* cancel) {
  CellResult result;
  const std::vector<RunOptions> crews = experiments::crews_of(cell, scenario);
  for (const RunOptions& crew : crews) {
    result.crews.push_back({.name = crew_name(scenario.line, crew)});
    result.crews.back().makespan.resize(cell.trials);
  }
  const std::size_t total = crews.size() * cell.trials;
  std::atomic<std::size_t> next = 0;
  std::mutex reporting;
  std::size_t done = 0;
  WorkerPool pool(0);
  pool.run(pool.size(), [&](std::size_t, std::size_t, std::size_t) {
    for (std::size_t i = next++; i < total; i = next++) {
      if (cancel != nullptr && cancel->requested()) return;
      const std::size_t crew = i / cell.trials;
      const std::size_t trial = i % cell.trials;
      const RunSetup setup = experiments::setup_of(cell, scenario, crews[crew], trial);
      result.crews[crew].makespan[trial] = experiments::bound_of(scenario, setup, cancel);
      const std::scoped_lock lock(reporting);
      if (progress) progress(++done, total);
    }
  });
  if (cancel != nullptr && cancel->requested()) return std::nullopt;
  return result;
}

}  // namespace

std::optional<CellResult> run_cell(const ExperimentCell& cell, const Scenario& scenario,
                                   const std::function<std::int64_t()>& now_ns,
                                   const TrialProgress& progress, const CancelToken* cancel) {
  const std::int64_t start = now_ns();
  auto result = cell.bound.empty() ? play(cell, scenario, now_ns, progress, cancel)
                                   : bounds(cell, scenario, progress, cancel);
  if (result) result->wall_s = static_cast<double>(now_ns() - start) / 1e9;
  return result;
}

}  // namespace linewright
