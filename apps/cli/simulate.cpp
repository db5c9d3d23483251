#include <algorithm>
#include <sstream>
#include <thread>

#include "common.hpp"
#include "linewright/allocation/allocator.hpp"
#include "linewright/base/diagnostic.hpp"
#include "linewright/base/files.hpp"
#include "linewright/evaluation/event_log_writer.hpp"
#include "linewright/evaluation/explanation_text.hpp"
#include "linewright/evaluation/gantt.hpp"
#include "linewright/evaluation/log_document.hpp"
#include "linewright/planning/episode.hpp"
#include "linewright/planning/planner.hpp"
#include "simulation_report.hpp"

namespace linewright::cli {
namespace {

Outcome play(const Scenario& scenario, const Simulator& simulator,
             const SimulateArguments& arguments, Watch* watch) {
  Outcome outcome;
  const RunOptions crew = one_crew(arguments.run, simulator.line());
  const RunSetup setup = sample_setup(simulator.line(), crew, arguments.run.seed);
  const Configuration& configuration = arguments.run.configuration;
  PlannerContext context = planner_context(scenario, configuration.allocator);
  context.threads = std::max(1U, std::thread::hardware_concurrency());  // one run: all for it
  const auto planner = PlannerRegistry::make(configuration.planner, simulator, context);
  const auto allocator = make_allocator(configuration.allocator, simulator);
  std::unique_ptr<Shield> shield;
  if (configuration.shield) shield = std::make_unique<Shield>(simulator);
  EpisodeOptions options{.log = &outcome.log, .cancel = &interrupted(), .shield = shield.get()};
  const auto base = PlannerRegistry::make("first", simulator);
  const auto base_allocator = make_allocator(configuration.allocator, simulator);
  const auto explain = [&](const SimulationState& state, const GuardedDecision& decision) {
    outcome.explained.push_back(
        explain_decision(simulator, state, decision, *base, *base_allocator));
    outcome.explanations +=
        explanation_text(simulator.line(), setup, outcome.explained.back()) + "\n";
  };
  if (arguments.explain || watch != nullptr) {
    options.observe = [&](const SimulationState& state, const GuardedDecision& decision) {
      if (watch != nullptr) watch->follow(outcome.log, 0.0, outcome.explained);
      if (arguments.explain) explain(state, decision);
    };
  }
  run_episode(simulator, outcome.state, setup, arguments.run.seed, *planner, *allocator, options);
  return outcome;
}

Outcome play_recorded(const Simulator& simulator, const SimulateArguments& arguments) {
  if (arguments.decisions.empty()) {
    throw ScenarioError({}, "--planner replay needs the decisions to replay",
                        "add --decisions FILE (docs/formats/decisions.md, or an event log)");
  }
  if (!arguments.run.humans.empty() || !arguments.run.robots.empty() ||
      !arguments.run.crew.empty()) {
    throw ScenarioError({}, "--planner replay takes the crew from the record",
                        "leave out --humans, --robots and --crew");
  }
  Outcome outcome;
  outcome.recorded = load_recorded_run(arguments.decisions, simulator.line());
  RunSetup& setup = outcome.recorded->setup;
  if (arguments.run.order) setup.order = *arguments.run.order;
  if (arguments.run.horizon) setup.horizon = *arguments.run.horizon;
  for (const Closure& closure : closures_of(arguments.run, simulator.line())) {
    setup.closures.push_back(closure);
  }
  setup.closures = joined_closures(std::move(setup.closures));
  check_setup(simulator.line(), setup);
  const auto fallback = make_allocator("first_idle", simulator);
  outcome.replayed =
      replay(simulator, outcome.state, setup, outcome.recorded->decisions, *fallback, &outcome.log);
  outcome.milestones = compare_milestones(*outcome.recorded, simulator.line(), outcome.log);
  return outcome;
}

void write_outputs(const Scenario& scenario, const Simulator& simulator,
                   const SimulateArguments& arguments, const Outcome& outcome) {
  if (arguments.log.empty() && arguments.gantt.empty()) return;
  const std::string text =
      event_log_text(scenario, outcome.log, simulator.progress(outcome.state), outcome.explained);
  if (!arguments.log.empty()) write_file(arguments.log, text);
  if (!arguments.gantt.empty()) {
    std::istringstream in(text);
    write_gantt(make_gantt(read_event_log(in, arguments.gantt)), arguments.gantt);
  }
}

int simulate(const SimulateArguments& arguments) {
  if (!arguments.log.empty() && arguments.log == arguments.gantt) {
    throw ScenarioError(arguments.log, "is named for the log and for the chart", "name two files");
  }
  const Scenario scenario = load(arguments.run.scenario);
  const Simulator simulator(std::make_shared<const LineModel>(scenario.line));
  const bool recorded = arguments.run.configuration.planner == "replay";
  if (arguments.explain && recorded) {
    throw ScenarioError({}, "--explain explains the decisions of a planner",
                        "leave out --explain, or let a planner decide");
  }
  if (arguments.explain && arguments.run.json && arguments.log.empty()) {
    throw ScenarioError({}, "--explain prints text, --json does not",
                        "add --log FILE, which holds the explanations, or leave out one of them");
  }
  if (!recorded && !arguments.decisions.empty()) {
    throw ScenarioError({}, "--decisions is only read by the planner 'replay'",
                        "add --planner replay");
  }
  const auto watch =
      arguments.watch.on ? std::make_unique<Watch>(scenario, arguments.watch) : nullptr;
  const Outcome outcome = recorded ? play_recorded(simulator, arguments)
                                   : play(scenario, simulator, arguments, watch.get());
  if (watch && outcome.state.ended()) {
    watch->follow(outcome.log, simulator.progress(outcome.state), outcome.explained);
    watch->finish();
  }
  if (!outcome.state.ended() || (watch && interrupted().requested())) {
    report("interrupted: nothing was written");
    return kInterrupted;
  }
  write_outputs(scenario, simulator, arguments, outcome);
  print(arguments.run.json ? simulation_json(simulator, arguments, outcome).dump(2) + "\n"
                           : outcome.explanations + simulation_text(simulator, arguments, outcome));
  return kOk;
}

}  // namespace

Command add_simulate(CLI::App& app) {
  auto arguments = std::make_shared<SimulateArguments>();
  add_scenario_option(app, arguments->run);
  add_run_options(app, arguments->run);
  add_configuration_options(app, arguments->run);
  add_shield_option(app, arguments->run);
  add_close_option(app, arguments->run);
  app.get_option("--planner")
      ->description(app.get_option("--planner")->get_description() +
                    ", or replay with --decisions");
  app.add_option("--decisions", arguments->decisions,
                 "Recorded decisions to replay (docs/formats/decisions.md), or an event log")
      ->type_name("FILE");
  app.add_flag("--explain", arguments->explain,
               "Print (and with --log write) for each decision what else could have been chosen, "
               "when the run would end then, what could not and why, and who else could do it");
  app.add_option("--log", arguments->log, "Write the event log here (docs/formats/event_log.md)")
      ->type_name("FILE.jsonl");
  app.add_option("--gantt", arguments->gantt, "Write the Gantt chart here")
      ->type_name("FILE.html|FILE.svg");
  add_watch_options(app, arguments->watch);
  app.footer(
      "Examples:\n  linewright simulate scenarios/duct_line.yaml --humans 2 --robots 2 "
      "--log out/run.jsonl --gantt out/run.html\n"
      "  linewright simulate scenarios/duct_line.yaml --humans 2 --robots 2 --watch");
  return [arguments] { return simulate(*arguments); };
}

}  // namespace linewright::cli
