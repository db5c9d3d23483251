#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

#include "common.hpp"
#include "joint_bound.hpp"
#include "linewright/base/diagnostic.hpp"
#include "linewright/bounds/lower_bounds.hpp"
#include "linewright/evaluation/log_document.hpp"
#include "linewright/evaluation/recorded_run.hpp"

namespace linewright::cli {
namespace {

using Json = nlohmann::ordered_json;

struct BoundArguments {
  RunArguments run;
  BoundOptions options;
  std::size_t starts = 1;
  std::optional<Tick> makespan;
  std::string log;
  std::string solver = "none";
  std::string budget = "60s";
  std::string python = "python3";
};

/// Bounds of one crew and start, and the makespan that they are compared with.
struct Report {
  std::string crew;
  std::uint64_t seed = 0;
  RunSetup setup;
  std::vector<Bound> bounds;
  std::optional<Tick> found;  ///< with a solver: a makespan that can be reached
};

/// The setup and the makespan of a recorded run.
std::pair<RunSetup, std::optional<Tick>> recorded(const BoundArguments& arguments,
                                                  const LineModel& line) {
  if (!arguments.run.humans.empty() || !arguments.run.robots.empty() ||
      !arguments.run.crew.empty() || arguments.run.order || arguments.starts > 1) {
    throw ScenarioError({}, "--log takes the crew, its start and the order from the log",
                        "leave out --humans, --robots, --crew, --order and --starts");
  }
  const RecordedRun run = load_recorded_run(arguments.log, line);
  check_setup(line, run.setup);
  if (!run.makespan) {
    throw ScenarioError(arguments.log,
                        "is the log of a run that did not finish: it has no makespan",
                        "take the log of a run with status finished");
  }
  return {run.setup, run.makespan};
}

/// Adds what the solver proves, the best bound first.
void prove(const BoundArguments& arguments, const Scenario& scenario, Report& report) {
  if (arguments.solver == "none" || interrupted().requested()) return;
  std::optional<JointBound> joint =
      joint_bound(scenario, report.setup, arguments.makespan,
                  {.budget_ns = parse_budget_ns(arguments.budget), .python = arguments.python});
  if (!joint) return;
  report.found = joint->found;
  report.bounds.push_back(std::move(joint->bound));
  std::stable_sort(report.bounds.begin(), report.bounds.end(),
                   [](const Bound& a, const Bound& b) { return a.ticks > b.ticks; });
}

std::vector<Report> reports_of(BoundArguments& arguments, const Scenario& scenario) {
  const LineModel& line = scenario.line;
  std::vector<Report> reports;
  if (!arguments.log.empty()) {
    if (arguments.makespan) {
      throw ScenarioError({}, "--log and --makespan both give a makespan", "leave one out");
    }
    auto [setup, makespan] = recorded(arguments, line);
    arguments.makespan = makespan;
    reports.push_back({.crew = crew_name(line, setup), .setup = std::move(setup)});
  } else {
    for (const RunOptions& crew : crews_of(arguments.run, line, false)) {
      for (std::size_t s = 0; s < arguments.starts; ++s) {
        const std::uint64_t seed = arguments.run.seed + s;
        RunSetup setup = sample_setup(line, crew, seed);
        reports.push_back(
            {.crew = crew_name(line, setup), .seed = seed, .setup = std::move(setup)});
      }
    }
  }
  if (arguments.makespan && reports.size() > 1) {
    throw ScenarioError({}, "--makespan is compared with one bound, but several crews are named",
                        "name one crew and one start");
  }
  for (Report& report : reports) {
    report.bounds = lower_bounds(line, report.setup, arguments.options, &interrupted());
    prove(arguments, scenario, report);
  }
  return reports;
}

Json to_json(const BoundArguments& arguments, const LineModel& line, const Report& report) {
  Json object{{"line", line.name},
              {"crew", report.crew},
              {"order", report.setup.order},
              {"bound", report.bounds[0].ticks},
              {"name", report.bounds[0].name}};
  if (arguments.log.empty()) object["seed"] = report.seed;
  if (arguments.makespan) {
    object["makespan"] = *arguments.makespan;
    object["gap"] = gap(*arguments.makespan, report.bounds[0].ticks);
  }
  if (report.found) {
    object["found"] = *report.found;
    object["found_gap"] = gap(*report.found, report.bounds[0].ticks);
  }
  object["bounds"] = Json::array();
  for (const Bound& bound : report.bounds) {
    object["bounds"].push_back(
        {{"name", bound.name}, {"ticks", bound.ticks}, {"argument", bound.argument}});
  }
  return object;
}

std::string to_text(const BoundArguments& arguments, const LineModel& line, const Report& report) {
  const Bound& best = report.bounds[0];
  std::string text = fmt::format(
      "No run of {} with crew {} can make {} {} in less than {} ticks ({:.1f} min).\n\n", line.name,
      report.crew, report.setup.order, line.order.product, best.ticks,
      best.ticks * line.tick_s / 60.0);
  for (const Bound& bound : report.bounds)
    text += fmt::format("{:>7}  {}\n         {}\n", bound.ticks, bound.name, bound.argument);
  if (arguments.makespan) {
    text += fmt::format("\nmakespan {}, bound {}: gap {}\n", *arguments.makespan, best.ticks,
                        percent(gap(*arguments.makespan, best.ticks), 1));
  }
  if (report.found) {
    text += fmt::format("\na run of {} ticks is known; bound {}: gap {}\n", *report.found,
                        best.ticks, percent(gap(*report.found, best.ticks), 1));
  }
  return text;
}

/// Several crews or starts: a row each, and the mean.
std::string to_table(const std::vector<Report>& reports) {
  const bool found = std::any_of(reports.begin(), reports.end(),
                                 [](const Report& report) { return report.found.has_value(); });
  std::vector<std::vector<std::string>> rows{{"crew", "seed", "bound", "by"}};
  if (found) rows[0].insert(rows[0].end(), {"found", "gap"});
  double sum = 0.0;
  for (const Report& report : reports) {
    sum += report.bounds[0].ticks;
    rows.push_back({report.crew, std::to_string(report.seed),
                    std::to_string(report.bounds[0].ticks), report.bounds[0].name});
    if (!found) continue;
    rows.back().push_back(report.found ? std::to_string(*report.found) : "-");
    rows.back().push_back(report.found ? percent(gap(*report.found, report.bounds[0].ticks), 1)
                                       : "-");
  }
  return text_table(rows) +
         fmt::format("mean of the bounds {:.1f}\n", sum / static_cast<double>(reports.size()));
}

/// A makespan below a bound of a run that really took place would be a defect.
void check_makespan(const BoundArguments& arguments, const std::vector<Report>& reports) {
  if (!arguments.makespan || *arguments.makespan >= reports[0].bounds[0].ticks) return;
  throw ScenarioError({},
                      fmt::format("a makespan of {} is below the bound of {}: no run of this crew "
                                  "and start can have it",
                                  *arguments.makespan, reports[0].bounds[0].ticks),
                      "give the --seed, the crew and the --order of the run");
}

int bound(BoundArguments& arguments) {
  static_cast<void>(parse_budget_ns(arguments.budget));  // a bad one before the work begins
  const Scenario scenario = load(arguments.run.scenario);
  const std::vector<Report> reports = reports_of(arguments, scenario);
  check_makespan(arguments, reports);
  if (arguments.run.json) {
    Json all = Json::array();
    for (const Report& one : reports) all.push_back(to_json(arguments, scenario.line, one));
    print((all.size() == 1 ? all[0] : all).dump(2) + "\n");
  } else {
    print(reports.size() == 1 ? to_text(arguments, scenario.line, reports[0]) : to_table(reports));
  }
  if (interrupted().requested()) {
    report("interrupted: these bounds hold, but higher ones were still being looked for");
    return kInterrupted;
  }
  return kOk;
}

}  // namespace

Command add_bound(CLI::App& app) {
  auto arguments = std::make_shared<BoundArguments>();
  add_scenario_option(app, arguments->run);
  add_run_options(app, arguments->run);
  app.get_option("--humans")->description("Numbers of workers of kind 'human': 2, 1..3 or 1,3");
  app.get_option("--robots")->description("Numbers of workers of kind 'robot': 2, 1..3 or 1,3");
  add_close_option(app, arguments->run);
  app.add_option("--starts", arguments->starts,
                 "Starts per crew, with seeds from --seed on; several make a table")
      ->capture_default_str()
      ->check(CLI::Range(std::size_t{1}, std::size_t{100'000}))
      ->type_name("N");
  app.add_option("--states", arguments->options.most_states,
                 "Most states kept per step when one worker's work is sequenced; 0: not at all")
      ->capture_default_str()
      ->check(CLI::Range(std::size_t{0}, std::size_t{10'000'000}))
      ->type_name("N");
  CLI::Option* solver =
      app.add_option(
             "--solver", arguments->solver,
             "Also prove a bound of all resources at once, with Google's CP-SAT: cp-sat, or "
             "none (needs Python with ortools)")
          ->capture_default_str()
          ->check(CLI::IsMember({"none", "cp-sat"}))
          ->type_name("NAME");
  app.add_option("--budget", arguments->budget, "With --solver: time per start: 10s, 5min")
      ->needs(solver)
      ->capture_default_str()
      ->type_name("TIME");
  app.add_option("--python", arguments->python, "With --solver: the Python that has ortools")
      ->needs(solver)
      ->capture_default_str()
      ->type_name("PROGRAM");
  app.add_option("--makespan", arguments->makespan, "A makespan to compare the bound with: the gap")
      ->check(CLI::PositiveNumber)
      ->type_name("TICKS");
  app.add_option("--log", arguments->log,
                 "An event log: the bound for its crew, start and order, and its gap")
      ->type_name("FILE.jsonl");
  app.footer(
      "A bound holds for every planner and every allocator (docs/bounds.md). "
      "gap = (makespan - bound) / bound.\n"
      "Example:\n  linewright bound scenarios/duct_line.yaml --humans 2 --robots 2 --seed 1 "
      "--makespan 760\n  linewright bound scenarios/duct_line.yaml --humans 2 --robots 2 --solver "
      "cp-sat --budget 30s --python ortools/bin/python");
  return [arguments] { return bound(*arguments); };
}

}  // namespace linewright::cli
