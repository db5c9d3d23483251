#include <fmt/format.h>

#include <memory>

#include "cell_runs.hpp"
#include "linewright/allocation/allocator.hpp"
#include "linewright/base/diagnostic.hpp"
#include "linewright/base/files.hpp"
#include "linewright/base/hash.hpp"
#include "linewright/bounds/lower_bounds.hpp"
#include "linewright/evaluation/event_log_writer.hpp"
#include "linewright/experiments/cell.hpp"
#include "linewright/planning/episode.hpp"
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

/// The cell's planner, or `first` where it has a budget in time and would never do the same twice.
std::unique_ptr<Planner> probing_planner(const ExperimentCell& cell, const Scenario& scenario,
                                         const Simulator& simulator) {
  const PlannerContext context{.allocator = cell.allocator,
                               .scenario_file = scenario.file,
                               .scenario_hash = scenario.content_hash};
  try {
    return PlannerRegistry::make(cell.planner, simulator, context);
  } catch (const ScenarioError&) {
    // Without a clock such planners cannot be made. If it is anything else that is wrong with the
    // name, this says so.
    PlannerContext timed = context;
    timed.now_ns = [] { return std::int64_t{0}; };
    static_cast<void>(PlannerRegistry::make(cell.planner, simulator, timed));
    return PlannerRegistry::make("first", simulator, context);
  }
}

/// All bounds of the smallest and the largest crew, with few states: what is quick to know, and
/// different when the arguments are.
std::string bounds_of(const ExperimentCell& cell, const Scenario& scenario) {
  constexpr std::size_t kFew = 100;
  const std::vector<RunOptions> crews = experiments::crews_of(cell, scenario);
  std::string text = fmt::format("{}", BoundOptions{}.most_states);
  for (const RunOptions& crew : {crews.front(), crews.back()}) {
    const RunSetup setup = experiments::setup_of(cell, scenario, crew, 0);
    for (const Bound& bound : lower_bounds(scenario.line, setup, {.most_states = kFew}))
      text += fmt::format(" {} {}", bound.name, bound.ticks);
  }
  return text;
}

/// How the first run of the largest crew goes.
std::string behaviour_of(const ExperimentCell& cell, const Scenario& scenario) {
  if (!cell.bound.empty()) return bounds_of(cell, scenario);
  const RunOptions crew = experiments::crews_of(cell, scenario).back();
  const RunSetup setup = experiments::setup_of(cell, scenario, crew, 0);
  const Simulator simulator(std::make_shared<const LineModel>(scenario.line));
  const auto planner = probing_planner(cell, scenario, simulator);
  const auto allocator = make_allocator(cell.allocator, simulator);
  std::unique_ptr<Shield> shield;
  if (cell.shield) shield = std::make_unique<Shield>(simulator);
  EventLog log;
  SimulationState state;
  run_episode(simulator, state, setup, cell.seed, *planner, *allocator,
              {.log = &log, .shield = shield.get()});
  return event_log_text(scenario, log, simulator.progress(state));
}

}  // namespace

std::string key_of(const ExperimentCell& cell, const Scenario& scenario) {
  const std::string who = cell.bound.empty() ? identity_of(cell.planner, scenario.file)
                                             : fmt::format("bound {}", cell.bound);
  const std::string text =
      fmt::format("{}|{:016x}|{}|{}|{}|{}|{}|{}|{}|{:016x}", experiments::kCellFormat,
                  scenario.content_hash, who, cell.allocator, cell.order, cell.horizon.value_or(0),
                  cell.trials, cell.seed, cell.shield, hash_of(behaviour_of(cell, scenario)));
  return fmt::format("{:016x}", hash_of(text));
}

}  // namespace linewright
