#include "linewright/experiments/cell.hpp"

#include <fmt/format.h>

#include "linewright/base/diagnostic.hpp"
#include "linewright/base/files.hpp"
#include "linewright/base/hash.hpp"
#include "linewright/evaluation/crews.hpp"
#include "linewright/planning/priority_file.hpp"

namespace linewright {
namespace {

constexpr std::size_t kMostBytes = std::size_t{1} << 30U;

std::string hash_of_file(const std::string& file) {
  std::string reason;
  const auto bytes = read_file(file, kMostBytes, reason);
  if (!bytes) throw ScenarioError(file, "cannot be read: " + reason, "");
  return fmt::format("{:016x}", hash_of(*bytes));
}

/// The planner by what it does: a policy by its bytes, not by where it lies.
std::string identity_of(const std::string& planner, const std::string& scenario_file) {
  constexpr std::string_view kPolicy = "policy:";
  if (planner.starts_with(kPolicy)) return hash_of_file(planner.substr(kPolicy.size()));
  if (planner.find("priority:tuned") == std::string::npos) return planner;
  return planner + " " + hash_of_file(priority_file_of(scenario_file));
}

}  // namespace

std::string key_of(const ExperimentCell& cell, const Scenario& scenario) {
  const std::string text =
      fmt::format("1|{:016x}|{}|{}|{}|{}|{}|{}|{}", scenario.content_hash,
                  identity_of(cell.planner, scenario.file), cell.allocator, cell.order,
                  cell.horizon.value_or(0), cell.trials, cell.seed, cell.shield);
  return fmt::format("{:016x}", hash_of(text));
}

std::optional<CellResult> run_cell(const ExperimentCell& cell, const Scenario& scenario,
                                   const std::function<std::int64_t()>& now_ns,
                                   const TrialProgress& progress, const CancelToken* cancel) {
  TrialPlan plan{.crews = all_crews(scenario.line),
                 .trials = cell.trials,
                 .seed = cell.seed,
                 .now_ns = now_ns};
  for (RunOptions& crew : plan.crews) {
    crew.order = cell.order;
    crew.horizon = cell.horizon;
  }
  const std::int64_t start = now_ns();
  const auto trials = run_trials(
      scenario, {.planner = cell.planner, .allocator = cell.allocator, .shield = cell.shield}, plan,
      progress, cancel);
  if (trials.size() < plan.crews.size()) return std::nullopt;
  CellResult result;
  for (std::size_t c = 0; c < trials.size(); ++c) {
    CellResult::Crew& crew = result.crews.emplace_back();
    crew.name = crew_name(scenario.line, plan.crews[c]);
    for (const TrialResult& trial : trials[c]) {
      crew.makespan.push_back(trial.makespan);
      crew.finished.push_back(trial.status == RunStatus::kFinished ? 1 : 0);
      crew.progress.push_back(trial.progress);
      crew.distance_m.push_back(static_cast<double>(trial.distance_mm) / 1000.0);
    }
  }
  result.wall_s = static_cast<double>(now_ns() - start) / 1e9;
  return result;
}

}  // namespace linewright
