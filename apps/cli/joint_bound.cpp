#include "joint_bound.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "common.hpp"
#include "filter_process.hpp"
#include "joint_json.hpp"
#include "linewright/base/diagnostic.hpp"
#include "linewright/base/files.hpp"
#include "linewright/planning/solve.hpp"

namespace linewright::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kScript = "joint_bound.py";

std::string script_file() {
  for (const std::string& folder : shipped_folders("apps/solver")) return folder + "/" + kScript;
  throw ScenarioError(kScript, "is missing: it belongs into apps/solver beside the program",
                      "take the whole repository or installation");
}

/// A run that finishes early, so that the solver need not look at what is later. None: interrupted.
std::optional<Solution> short_search(const Scenario& scenario, const RunSetup& setup) try {
  constexpr std::size_t kFutures = 3000;
  const Simulator simulator(std::make_shared<const LineModel>(scenario.line));
  return solve(simulator, setup, {.free_agents = true, .wait = true, .rollouts = kFutures},
               planner_context(scenario, "sap"));
} catch (const ScenarioError&) {
  if (!interrupted().requested()) throw;
  return std::nullopt;
}

struct Proven {
  Tick ticks = 1;
  std::size_t closed = 0;
  std::size_t cases = 0;
};

Proven proven_by(const std::string& line, const std::string& script) {
  try {
    const Json json = Json::parse(line);
    return {json.at("bound"), json.at("closed"), json.at("cases")};
  } catch (const Json::exception&) {
    throw ScenarioError(script, "said what cannot be read: " + line, "");
  }
}

std::string argument_of(const Proven& proven, Tick limit, std::size_t resources) {
  std::string text = fmt::format(
      "Everything that a run must keep, and {} kinds of resources at once (machines with their "
      "travel, workers with their ways, carriers), as one scheduling problem",
      resources);
  if (proven.cases > 1)
    text +=
        fmt::format(" for each of {} ways to share the tokens of the line's forks", proven.cases);
  text += proven.ticks >= limit
              ? "; CP-SAT has proven that no solution ends before the makespan that was found."
          : proven.closed == proven.cases
              ? "; CP-SAT has found the best solution of each."
              : "; CP-SAT has proven so much in its time (a longer --budget may prove more).";
  return text;
}

}  // namespace

std::optional<JointBound> joint_bound(const Scenario& scenario, const RunSetup& setup,
                                      std::optional<Tick> known, const JointOptions& options) {
  const std::string script = script_file();
  JointBound made;
  Tick limit = known.value_or(0);
  if (!known) {
    const std::optional<Solution> solution = short_search(scenario, setup);
    if (!solution) return std::nullopt;
    limit = solution->makespan;  // of one that does not finish: the horizon
    if (solution->finished) made.found = limit;
  }
  const auto relaxations = joint_relaxations(scenario.line, setup, limit);
  made.bound = {.name = "joint:cp_sat", .ticks = limit, .argument = {}};
  if (relaxations.empty()) {
    made.bound.argument =
        "Without any competition the run cannot end before the makespan below which one was looked "
        "for.";
    return made;
  }
  Json cases = Json::array();
  for (const JointRelaxation& one : relaxations) cases.push_back(to_json(one));
  const double seconds = static_cast<double>(options.budget_ns) * 1e-9;
  ProgressBar bar("CP-SAT");
  Proven proven;
  const auto started = clock_ns();
  const FilterResult result =
      run_filter({options.python, script, "--seconds", fmt::format("{}", seconds), "--threads",
                  fmt::format("{}", std::max(1U, std::thread::hardware_concurrency()))},
                 cases.dump(), [&](const std::string& line) {
                   if (line.empty()) return;
                   proven = proven_by(line, script);
                   const double spent = static_cast<double>(clock_ns() - started) * 1e-9;
                   bar.update(static_cast<std::size_t>(std::min(spent, seconds) * 10),
                              static_cast<std::size_t>(std::ceil(seconds * 10)),
                              fmt::format("proven {} of {}", proven.ticks, limit));
                 });
  if (!result.success && !interrupted().requested()) {
    throw ScenarioError(options.python, "cannot prove a bound: " + result.last_error,
                        "install ortools for it (python3 -m venv FOLDER; FOLDER/bin/pip install "
                        "ortools) and give --python FOLDER/bin/python, or leave out --solver");
  }
  if (proven.cases == 0) {
    if (interrupted().requested()) return std::nullopt;
    throw ScenarioError(script, "ended without a word about what is proven", "");
  }
  made.bound.ticks = proven.ticks;
  made.bound.argument = argument_of(proven, limit, relaxations[0].resources.size());
  return made;
}

}  // namespace linewright::cli
