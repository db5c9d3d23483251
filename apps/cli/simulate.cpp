#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "common.hpp"
#include "linewright/allocation/allocator.hpp"
#include "linewright/base/diagnostic.hpp"
#include "linewright/base/files.hpp"
#include "linewright/evaluation/event_log_writer.hpp"
#include "linewright/evaluation/gantt.hpp"
#include "linewright/evaluation/log_document.hpp"
#include "linewright/evaluation/recorded_run.hpp"
#include "linewright/planning/episode.hpp"
#include "linewright/planning/explain.hpp"
#include "linewright/planning/planner.hpp"
#include "linewright/planning/replay.hpp"

namespace linewright::cli {
namespace {

using Json = nlohmann::ordered_json;

struct SimulateArguments {
  RunArguments run;
  std::string log;
  std::string gantt;
  std::string decisions;
  bool explain = false;
};

/// A run that has ended, and what a replay had to compare.
struct Outcome {
  SimulationState state;
  EventLog log;
  std::optional<RecordedRun> recorded;
  ReplayResult replayed;
  std::vector<MilestoneComparison> milestones;
  std::string explanations;  ///< with --explain: of every decision, in order
};

Outcome play(const Scenario& scenario, const Simulator& simulator,
             const SimulateArguments& arguments) {
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
  if (arguments.explain) {
    options.observe = [&](const SimulationState& state, const GuardedDecision& decision) {
      const DecisionExplanation explanation =
          explain_decision(simulator, state, decision, *base, *base_allocator);
      outcome.explanations += explanation_text(simulator, state, explanation) + "\n";
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

std::optional<Tick> largest_difference(const Outcome& outcome) {
  std::optional<Tick> largest;
  for (const MilestoneComparison& milestone : outcome.milestones) {
    if (!milestone.ours) continue;
    const Tick difference = std::abs(*milestone.ours - milestone.recorded.tick);
    largest = std::max(largest.value_or(0), difference);
  }
  return largest;
}

std::size_t missing_milestones(const Outcome& outcome) {
  return static_cast<std::size_t>(std::count_if(
      outcome.milestones.begin(), outcome.milestones.end(), [](const auto& m) { return !m.ours; }));
}

Json replay_json(const Outcome& outcome, const LineModel& line) {
  Json object{{"decisions", outcome.recorded->decisions.size()}};
  std::size_t taken = 0;
  Json late = Json::array();
  for (std::size_t i = 0; i < outcome.replayed.decisions.size(); ++i) {
    const ReplayedDecision& decision = outcome.replayed.decisions[i];
    if (decision.taken) ++taken;
    if (decision.taken == decision.recorded) continue;
    late.push_back({{"n", i + 1},
                    {"task", line.tasks[outcome.recorded->decisions[i].task.index()].name},
                    {"recorded", decision.recorded},
                    {"taken", decision.taken ? Json(*decision.taken) : Json(nullptr)},
                    {"reason", decision.refusal}});
  }
  object["taken"] = taken;
  object["deviations"] = std::move(late);
  object["recorded_finished"] =
      outcome.recorded->finished ? Json(*outcome.recorded->finished) : Json();
  object["recorded_makespan"] =
      outcome.recorded->makespan ? Json(*outcome.recorded->makespan) : Json();
  const auto largest = largest_difference(outcome);
  object["milestones"] = {{"compared", outcome.milestones.size() - missing_milestones(outcome)},
                          {"missing", missing_milestones(outcome)},
                          {"largest_difference", largest ? Json(*largest) : Json()}};
  return object;
}

Json shares_json(const WorkerShares& shares) {
  return {{"work", shares.work},
          {"travel", shares.travel},
          {"wait", shares.wait},
          {"idle", shares.idle}};
}

Json to_json(const Simulator& simulator, const SimulateArguments& arguments,
             const Outcome& outcome) {
  const LineModel& line = simulator.line();
  const TrialResult result = measure(outcome.state, simulator.progress(outcome.state));
  const bool finished = outcome.state.status == RunStatus::kFinished;
  Json object{{"finished", finished},
              {"makespan", finished ? Json(outcome.state.now) : Json(nullptr)},
              {"progress", result.progress},
              {"status", run_status_name(outcome.state.status)},
              {"ended_at", outcome.state.now},
              {"line", line.name},
              {"order", outcome.log.setup.order},
              {"horizon", outcome.log.setup.horizon},
              {"decisions", result.decisions},
              {"distance_m", static_cast<double>(result.distance_mm) / 1000.0},
              {"distance_ticks", result.distance_ticks}};
  object["crew"] = Json::object();
  for (std::size_t k = 0; k < line.worker_kinds.size(); ++k) {
    object["crew"][line.worker_kinds[k].name] = outcome.log.setup.worker_start[k].size();
  }
  object["workers"] = Json::object();
  const auto names = worker_names(line, outcome.log.setup);
  for (std::size_t w = 0; w < names.size(); ++w)
    object["workers"][names[w]] = shares_json(result.workers[w]);
  object["machines"] = Json::object();
  for (std::size_t m = 0; m < line.machines.size(); ++m) {
    object["machines"][line.machines[m].name] = result.machines[m];
  }
  if (outcome.recorded) object["replay"] = replay_json(outcome, line);
  if (!arguments.log.empty()) object["log"] = arguments.log;
  if (!arguments.gantt.empty()) object["gantt"] = arguments.gantt;
  return object;
}

std::string percent(double share) { return fmt::format("{:.0f} %", share * 100.0); }

std::string deadlock_text(const Simulator& simulator, const Outcome& outcome) {
  std::string text = "Nothing is under way and no task can start:\n";
  for (std::size_t t = 0; t < simulator.line().tasks.size(); ++t) {
    text += fmt::format("  {}: {}\n", simulator.line().tasks[t].name,
                        simulator.explain_unselectable(outcome.state, TaskId(t)));
  }
  return text;
}

std::string replay_text(const Outcome& outcome, const LineModel& line) {
  std::vector<std::vector<std::string>> rows{{"replay", "recorded", "ours", "difference"}};
  const auto row = [&](std::string what, std::optional<Tick> recorded, std::optional<Tick> ours) {
    rows.push_back({std::move(what), recorded ? std::to_string(*recorded) : "-",
                    ours ? std::to_string(*ours) : "-",
                    recorded && ours ? fmt::format("{:+}", *ours - *recorded) : "-"});
  };
  const bool finished = outcome.state.status == RunStatus::kFinished;
  row("makespan", outcome.recorded->makespan,
      finished ? std::optional(outcome.state.now) : std::nullopt);
  std::string reasons;
  for (std::size_t i = 0; i < outcome.replayed.decisions.size(); ++i) {
    const ReplayedDecision& decision = outcome.replayed.decisions[i];
    if (decision.taken == decision.recorded) continue;
    const std::string& task = line.tasks[outcome.recorded->decisions[i].task.index()].name;
    row(fmt::format("decision {} {}", i + 1, task), decision.recorded, decision.taken);
    reasons +=
        fmt::format("  decision {} at tick {}: {}\n", i + 1, decision.recorded, decision.refusal);
  }
  std::size_t exact = 0;
  for (const MilestoneComparison& milestone : outcome.milestones) {
    if (milestone.ours == milestone.recorded.tick) {
      ++exact;
      continue;
    }
    row(fmt::format("{} {}", milestone.recorded.name, milestone.recorded.label),
        milestone.recorded.tick, milestone.ours);
  }
  std::string text = text_table(rows);
  text += fmt::format(
      "{} of {} decisions taken, {} of {} milestones exact\n",
      std::count_if(outcome.replayed.decisions.begin(), outcome.replayed.decisions.end(),
                    [](const auto& d) { return d.taken.has_value(); }),
      outcome.recorded->decisions.size(), exact, outcome.milestones.size());
  if (!reasons.empty()) text += "Decisions that were not possible at their tick:\n" + reasons;
  return text;
}

std::string to_text(const Simulator& simulator, const SimulateArguments& arguments,
                    const Outcome& outcome) {
  const LineModel& line = simulator.line();
  const TrialResult result = measure(outcome.state, simulator.progress(outcome.state));
  const bool finished = outcome.state.status == RunStatus::kFinished;
  std::string text = text_table({
      {"line", line.name},
      {"order", fmt::format("{} {}", outcome.log.setup.order, line.order.product)},
      {"status", run_status_name(outcome.state.status)},
      {finished ? "makespan" : "stopped at", fmt::format("{} ticks ({:.1f} min)", outcome.state.now,
                                                         outcome.state.now * line.tick_s / 60.0)},
      {"progress", percent(result.progress)},
      {"decisions", std::to_string(result.decisions)},
      {"distance", fmt::format("{:.0f} m", static_cast<double>(result.distance_mm) / 1000.0)},
  });
  std::vector<std::vector<std::string>> rows{{"worker", "work", "travel", "wait", "idle"}};
  const auto names = worker_names(line, outcome.log.setup);
  for (std::size_t w = 0; w < names.size(); ++w) {
    const WorkerShares& shares = result.workers[w];
    rows.push_back({names[w], percent(shares.work), percent(shares.travel), percent(shares.wait),
                    percent(shares.idle)});
  }
  text += "\n" + text_table(rows);
  rows = {{"machine", "busy"}};
  for (std::size_t m = 0; m < line.machines.size(); ++m) {
    rows.push_back({line.machines[m].name, percent(result.machines[m])});
  }
  if (rows.size() > 1) text += "\n" + text_table(rows);
  if (outcome.recorded) text += "\n" + replay_text(outcome, line);
  if (outcome.state.status == RunStatus::kDeadlock)
    text += "\n" + deadlock_text(simulator, outcome);
  if (!arguments.log.empty() || !arguments.gantt.empty()) text += "\n";
  if (!arguments.log.empty()) text += "event log    " + arguments.log + "\n";
  if (!arguments.gantt.empty()) text += "Gantt chart  " + arguments.gantt + "\n";
  return text;
}

void write_outputs(const Scenario& scenario, const Simulator& simulator,
                   const SimulateArguments& arguments, const Outcome& outcome) {
  if (arguments.log.empty() && arguments.gantt.empty()) return;
  const std::string text = event_log_text(scenario, outcome.log, simulator.progress(outcome.state));
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
  if (arguments.explain && (recorded || arguments.run.json)) {
    throw ScenarioError({}, "--explain prints text about the decisions of a planner",
                        recorded ? "leave out --explain, or let a planner decide"
                                 : "leave out --json or --explain");
  }
  if (!recorded && !arguments.decisions.empty()) {
    throw ScenarioError({}, "--decisions is only read by the planner 'replay'",
                        "add --planner replay");
  }
  const Outcome outcome =
      recorded ? play_recorded(simulator, arguments) : play(scenario, simulator, arguments);
  if (!outcome.state.ended()) {
    report("interrupted: nothing was written");
    return kInterrupted;
  }
  write_outputs(scenario, simulator, arguments, outcome);
  print(outcome.explanations);
  print(arguments.run.json ? to_json(simulator, arguments, outcome).dump(2) + "\n"
                           : to_text(simulator, arguments, outcome));
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
               "Print for each decision what else could have been chosen, how long the run would "
               "take then, what could not and why, and who else could have done it");
  app.add_option("--log", arguments->log, "Write the event log here (docs/formats/event_log.md)")
      ->type_name("FILE.jsonl");
  app.add_option("--gantt", arguments->gantt, "Write the Gantt chart here")
      ->type_name("FILE.html|FILE.svg");
  app.footer(
      "Example:\n  linewright simulate scenarios/duct_line.yaml --humans 2 --robots 2 "
      "--log out/run.jsonl --gantt out/run.html");
  return [arguments] { return simulate(*arguments); };
}

}  // namespace linewright::cli
