#include "linewright/planning/solve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "common.hpp"
#include "linewright/allocation/allocator.hpp"
#include "linewright/base/diagnostic.hpp"
#include "linewright/base/files.hpp"
#include "linewright/evaluation/event_log_writer.hpp"
#include "linewright/evaluation/gantt.hpp"
#include "linewright/evaluation/log_document.hpp"

namespace linewright::cli {
namespace {

using Json = nlohmann::ordered_json;

struct SolveArguments {
  RunArguments run;
  std::string budget = "60s";
  std::size_t rollouts = 0;
  std::size_t starts = 1;
  std::size_t threads = 0;
  std::string agents = "allocator";
  bool wait = false;
  std::vector<std::string> warm_starts;
  std::string log;
  std::string gantt;
};

/// One start, solved.
struct Solved {
  std::string crew;
  std::uint64_t seed = 0;
  Solution solution;
  EventLog log;
  double progress = 0.0;
};

SolveOptions options_of(const SolveArguments& arguments, std::uint64_t seed) {
  SolveOptions options{.free_agents = arguments.agents == "free",
                       .wait = arguments.wait,
                       .rollouts = arguments.rollouts,
                       .seed = seed};
  if (arguments.rollouts == 0) options.budget_ns = parse_budget_ns(arguments.budget);
  for (const std::string& list : arguments.warm_starts) {
    for (std::string& planner : split_planners(list)) {
      options.warm_starts.push_back(std::move(planner));
    }
  }
  return options;
}

Solved solve_one(const Simulator& simulator, const RunSetup& setup, const SolveOptions& options,
                 const PlannerContext& context) {
  Solved solved{.seed = options.seed};
  ProgressBar bar("solve");
  solved.solution = solve(simulator, setup, options, context, [&](const SolveProgress& now) {
    constexpr std::size_t kSteps = 1000;
    bar.update(static_cast<std::size_t>(now.share * static_cast<double>(kSteps)), kSteps,
               now.finished ? fmt::format("best {}", now.makespan) : "not finished yet");
  });
  SimulationState state;
  const auto fallback = make_allocator(context.allocator, simulator);
  static_cast<void>(
      replay(simulator, state, setup, solved.solution.decisions, *fallback, &solved.log));
  solved.progress = simulator.progress(state);
  if (solved.solution.finished && state.now != solved.solution.makespan) {
    throw std::logic_error("the plan found gives another makespan when it is run");
  }
  return solved;
}

void write_outputs(const SolveArguments& arguments, const Scenario& scenario,
                   const Solved& solved) {
  if (arguments.log.empty() && arguments.gantt.empty()) return;
  const std::string text = event_log_text(scenario, solved.log, solved.progress);
  if (!arguments.log.empty()) write_file(arguments.log, text);
  if (arguments.gantt.empty()) return;
  std::istringstream in(text);
  write_gantt(make_gantt(read_event_log(in, arguments.gantt)), arguments.gantt);
}

double mean_makespan(const std::vector<Solved>& all) {
  double sum = 0.0;
  for (const Solved& solved : all) sum += solved.solution.makespan;
  return all.empty() ? 0.0 : sum / static_cast<double>(all.size());
}

std::string to_text(const SolveArguments& arguments, const std::vector<Solved>& all) {
  std::vector<std::vector<std::string>> rows{
      {"crew", "seed", "makespan", "started from", "decisions", "futures"}};
  for (const Solved& solved : all) {
    const Solution& solution = solved.solution;
    rows.push_back({solved.crew, std::to_string(solved.seed),
                    solution.finished ? std::to_string(solution.makespan) : "not finished",
                    std::to_string(solution.warm_makespan),
                    std::to_string(solution.decisions.size()), std::to_string(solution.rollouts)});
  }
  std::string text = text_table(rows);
  if (all.size() > 1) text += fmt::format("mean makespan {:.2f}\n", mean_makespan(all));
  if (!arguments.log.empty()) text += "event log    " + arguments.log + "\n";
  if (!arguments.gantt.empty()) text += "Gantt chart  " + arguments.gantt + "\n";
  return text;
}

Json to_json(const SolveArguments& arguments, const LineModel& line,
             const std::vector<Solved>& all) {
  Json object{{"line", line.name}, {"allocator", arguments.run.configuration.allocator}};
  object["agents"] = arguments.agents;
  object["wait"] = arguments.wait;
  object["runs"] = Json::array();
  for (const Solved& solved : all) {
    const Solution& solution = solved.solution;
    object["runs"].push_back(
        {{"crew", solved.crew},
         {"seed", solved.seed},
         {"finished", solution.finished},
         {"makespan", solution.finished ? Json(solution.makespan) : Json()},
         {"warm_start", {{"planner", solution.warm_start}, {"makespan", solution.warm_makespan}}},
         {"decisions", solution.decisions.size()},
         {"futures", solution.rollouts}});
  }
  object["mean_makespan"] = mean_makespan(all);
  if (!arguments.log.empty()) object["log"] = arguments.log;
  if (!arguments.gantt.empty()) object["gantt"] = arguments.gantt;
  return object;
}

void refuse_files_of_several(const SolveArguments& arguments, std::size_t runs) {
  if (!arguments.log.empty() && arguments.log == arguments.gantt) {
    throw ScenarioError(arguments.log, "is named for the log and for the chart", "name two files");
  }
  if (runs == 1 || (arguments.log.empty() && arguments.gantt.empty())) return;
  throw ScenarioError({}, fmt::format("--log and --gantt are for one run, but these are {}", runs),
                      "give one number per kind of worker and --starts 1");
}

int solve_command(const SolveArguments& arguments) {
  static_cast<void>(options_of(arguments, 1));  // bad ones before the scenario is loaded
  const Scenario scenario = load(arguments.run.scenario);
  const Simulator simulator(std::make_shared<const LineModel>(scenario.line));
  const std::vector<RunOptions> crews = crews_of(arguments.run, scenario.line, false);
  refuse_files_of_several(arguments, crews.size() * arguments.starts);
  PlannerContext context = planner_context(scenario, arguments.run.configuration.allocator);
  context.threads =
      arguments.threads > 0 ? arguments.threads : std::max(1U, std::thread::hardware_concurrency());
  std::vector<Solved> all;
  for (const RunOptions& crew : crews) {
    for (std::size_t s = 0; s < arguments.starts && !interrupted().requested(); ++s) {
      const std::uint64_t seed = arguments.run.seed + s;
      const RunSetup setup = sample_setup(scenario.line, crew, seed);
      all.push_back(solve_one(simulator, setup, options_of(arguments, seed), context));
      all.back().crew = crew_name(scenario.line, setup);
    }
  }
  if (all.size() == 1) write_outputs(arguments, scenario, all[0]);
  print(arguments.run.json ? to_json(arguments, scenario.line, all).dump(2) + "\n"
                           : to_text(arguments, all));
  if (!interrupted().requested()) return kOk;
  report("interrupted: these are the best plans so far");
  return kInterrupted;
}

}  // namespace

Command add_solve(CLI::App& app) {
  auto arguments = std::make_shared<SolveArguments>();
  add_scenario_option(app, arguments->run);
  add_run_options(app, arguments->run);
  app.add_option(
         "--allocator", arguments->run.configuration.allocator,
         fmt::format("Who chooses the people and robots: {}", fmt::join(allocator_names(), ", ")))
      ->capture_default_str()
      ->type_name("NAME");
  add_close_option(app, arguments->run);
  CLI::Option* budget =
      app.add_option("--budget", arguments->budget, "Time to search in, per run: 500ms, 60s, 5min")
          ->capture_default_str()
          ->type_name("TIME");
  app.add_option("--rollouts", arguments->rollouts,
                 "Instead of a time: futures to play, with the same result on every machine")
      ->check(CLI::Range(std::size_t{1}, std::size_t{1'000'000'000'000}))
      ->excludes(budget)
      ->type_name("N");
  app.add_option("--starts", arguments->starts,
                 "Start positions per crew: seeds SEED, SEED + 1, ...")
      ->capture_default_str()
      ->check(CLI::Range(std::size_t{1}, std::size_t{100'000}))
      ->type_name("N");
  app.add_option("--agents", arguments->agents,
                 "Who chooses the people and robots: the allocator, or "
                 "the search, too (free)")
      ->capture_default_str()
      ->check(CLI::IsMember({"allocator", "free"}))
      ->type_name("allocator|free");
  app.add_flag("--wait", arguments->wait, "The search may wait although a task is possible");
  app.add_option("--from", arguments->warm_starts,
                 "Planners whose runs the search starts from, besides every rule; several with "
                 "commas")
      ->type_name("PLANNER,...")
      ->allow_extra_args(false);
  app.add_option("--threads", arguments->threads, "Threads; 0: one per core")
      ->capture_default_str()
      ->check(CLI::Range(std::size_t{0}, std::size_t{1024}))
      ->type_name("N");
  app.add_option("--log", arguments->log, "Write the event log here (docs/formats/event_log.md)")
      ->type_name("FILE.jsonl");
  app.add_option("--gantt", arguments->gantt, "Write the Gantt chart here")
      ->type_name("FILE.html|FILE.svg");
  app.footer(
      "Ctrl-C keeps the best plan so far.\nExample:\n  linewright solve scenarios/duct_line.yaml "
      "--humans 2 --robots 2 --budget 10s --agents free --wait --log out/best.jsonl");
  return [arguments] { return solve_command(*arguments); };
}

}  // namespace linewright::cli
