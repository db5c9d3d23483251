#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "common.hpp"
#include "linewright/base/diagnostic.hpp"
#include "linewright/planning/dead_states.hpp"

namespace linewright::cli {
namespace {

using Json = nlohmann::ordered_json;

struct CheckArguments {
  RunArguments run;
  DeadStateOptions options;
  bool strict = false;
};

/// What was found for one crew.
struct CrewFindings {
  std::string crew;
  Liveness start;
  DeadStateReport report;
};

const char* verdict_text(Liveness::Verdict verdict) {
  switch (verdict) {
    case Liveness::Verdict::kAlive:
      return "can be finished";
    case Liveness::Verdict::kDead:
      return "can never be finished";
    case Liveness::Verdict::kUnknown:
      return "could not be shown to be possible within the search limits";
  }
  return "";
}

CrewFindings examine(const Simulator& simulator, const RunOptions& crew,
                     const CheckArguments& arguments) {
  CrewFindings findings;
  const RunSetup setup = sample_setup(simulator.line(), crew, arguments.run.seed);
  findings.crew = crew_name(simulator.line(), setup);
  SimulationState state;
  simulator.reset(state, setup);
  findings.start = can_finish(simulator, state, arguments.options, &interrupted());
  if (findings.start.verdict != Liveness::Verdict::kDead) {
    findings.report = find_dead_states(simulator, crew, arguments.options, &interrupted());
  }
  return findings;
}

Json dead_state_json(const LineModel& line, const DeadState& dead) {
  Json object{{"task", line.tasks[dead.decisions.back().task.index()].name},
              {"tick", dead.decisions.back().tick},
              {"decision", dead.decisions.size()},
              {"proven", dead.proven},
              {"states_searched", dead.states_searched},
              {"occurrences", dead.occurrences},
              {"stuck_at", dead.stuck_at},
              {"decisions", Json::array()},
              {"reasons", Json::object()}};
  for (const auto& decision : dead.decisions) {
    object["decisions"].push_back(
        {{"tick", decision.tick}, {"task", line.tasks[decision.task.index()].name}});
  }
  for (std::size_t t = 0; t < dead.reasons.size(); ++t)
    object["reasons"][line.tasks[t].name] = dead.reasons[t];
  return object;
}

std::string dead_state_text(const LineModel& line, const DeadState& dead, std::int32_t order) {
  const auto name = [&](const DeadState::Decision& d) { return line.tasks[d.task.index()].name; };
  std::string text = fmt::format(
      "  dead state: after decision {}, {} at tick {}, the order of {} can never be finished\n",
      dead.decisions.size(), name(dead.decisions.back()), dead.decisions.back().tick, order);
  text += dead.proven ? fmt::format("    proven: all {} states that can follow were searched\n",
                                    dead.states_searched)
                      : fmt::format("    not proven: no way to finish among {} states searched\n",
                                    dead.states_searched);
  text += fmt::format("    seen in {} of the runs; decisions so far:", dead.occurrences);
  constexpr std::size_t kShown = 5;  // the last ones tell most; --json has all
  const std::size_t first = dead.decisions.size() > kShown ? dead.decisions.size() - kShown : 0;
  if (first > 0) text += " ...";
  for (std::size_t i = first; i < dead.decisions.size(); ++i) {
    text += fmt::format(" {}@{}", name(dead.decisions[i]), dead.decisions[i].tick);
  }
  text += fmt::format("\n    everything stands still from tick {} on:\n", dead.stuck_at);
  for (std::size_t t = 0; t < dead.reasons.size(); ++t) {
    text += fmt::format("      {}: {}\n", line.tasks[t].name, dead.reasons[t]);
  }
  return text;
}

/// The diagnostics as JSON on standard output, for `--json`; the text goes to standard error as
/// always.
Scenario load_reporting(const CheckArguments& arguments) {
  try {
    return load(arguments.run.scenario);
  } catch (const ScenarioError& error) {
    if (arguments.run.json) {
      Json object{{"valid", false}, {"diagnostics", Json::array()}};
      for (const Diagnostic& d : error.diagnostics()) {
        object["diagnostics"].push_back({{"file", d.file},
                                         {"line", d.line},
                                         {"column", d.column},
                                         {"message", d.message},
                                         {"hint", d.hint}});
      }
      print(object.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
    }
    throw;
  }
}

int check(const CheckArguments& arguments) {
  const Scenario scenario = load_reporting(arguments);
  const LineModel& line = scenario.line;
  const Simulator simulator(std::make_shared<const LineModel>(line));
  std::string text =
      fmt::format("{}: valid: {} tasks, {} operations, {} machines, {} places, {} stations\n",
                  arguments.run.scenario, line.tasks.size(), line.operations.size(),
                  line.machines.size(), line.places.size(), line.stations.size());
  Json object{{"valid", true},
              {"line", line.name},
              {"crews", Json::array()},
              {"dead_states", Json::array()}};
  const std::int32_t order = arguments.run.order.value_or(line.order.quantity);
  const std::vector<RunOptions> crews = crews_of(arguments.run, line, true);
  bool found = false;
  bool impossible = false;
  ProgressBar bar("check");
  for (std::size_t c = 0; c < crews.size() && !interrupted().requested(); ++c) {
    bar.update(c, crews.size());
    const CrewFindings findings = examine(simulator, crews[c], arguments);
    const bool dead = findings.start.verdict == Liveness::Verdict::kDead;
    impossible = impossible || dead;
    found = found || dead || !findings.report.found.empty();
    object["crews"].push_back({{"crew", findings.crew},
                               {"start", verdict_text(findings.start.verdict)},
                               {"runs", findings.report.runs},
                               {"stuck", findings.report.stuck}});
    text += fmt::format("{}: an order of {} {}", findings.crew, order,
                        verdict_text(findings.start.verdict));
    text += dead ? ", whatever is decided\n"
                 : fmt::format("; {} of {} random runs come to a stand\n", findings.report.stuck,
                               findings.report.runs);
    for (const DeadState& state : findings.report.found) {
      text += dead_state_text(line, state, order);
      Json entry = dead_state_json(line, state);
      entry["crew"] = findings.crew;
      object["dead_states"].push_back(std::move(entry));
    }
  }
  print(arguments.run.json ? object.dump(2) + "\n" : text);
  if (interrupted().requested()) {
    report("interrupted: not all crews were searched");
    return kInterrupted;
  }
  if (impossible) {
    report(fmt::format(
        "{}: error: an order of {} can never be finished\n  hint: look at stocks, capacities and "
        "conditions; the crews are listed on standard output",
        arguments.run.scenario, order));
    return kBadInput;
  }
  return found && arguments.strict ? kFound : kOk;
}

}  // namespace

Command add_check(CLI::App& app) {
  auto arguments = std::make_shared<CheckArguments>();
  add_scenario_option(app, arguments->run);
  add_run_options(app, arguments->run);
  app.get_option("--humans")
      ->description("Numbers of humans to check: 2, 1..3 or 1,3 (default: all)");
  app.get_option("--robots")
      ->description("Numbers of robots to check: 2, 1..3 or 1,3 (default: all)");
  app.add_option("--runs", arguments->options.runs,
                 "Random runs per crew that look for dead states; 0: none")
      ->capture_default_str()
      ->check(CLI::Range(std::size_t{0}, std::size_t{1'000'000}))
      ->type_name("N");
  app.add_flag("--strict", arguments->strict, "Exit with 1 when a dead state was found");
  app.footer(
      "A dead state is a reachable state from which the order can never be finished.\n"
      "Example:\n  linewright check scenarios/duct_line.yaml --humans 1 --robots 1");
  return [arguments] { return check(*arguments); };
}

}  // namespace linewright::cli
