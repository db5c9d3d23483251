#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string_view>

#include "common.hpp"
#include "evaluation.hpp"
#include "linewright/allocation/allocator.hpp"
#include "linewright/base/diagnostic.hpp"
#include "linewright/base/files.hpp"

namespace linewright::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct EvaluateArguments {
  RunArguments run;
  std::vector<std::string> planners;
  std::size_t trials = 100;
  std::size_t threads = 0;
  std::string csv;
  std::string versus;
  bool utilisation = false;
};

/// "PLANNER", "PLANNER+ALLOCATOR" or "+ALLOCATOR"; what is missing is as in `base`.
Configuration parse_versus(const std::string& text, const Configuration& base) {
  Configuration configuration = base;
  const std::size_t plus = text.find('+');
  if (plus != 0) configuration.planner = text.substr(0, plus);
  if (plus != std::string::npos) configuration.allocator = text.substr(plus + 1);
  return configuration;
}

/// One thing to evaluate. `folder`: "policy:FOLDER" where that named the planner, else empty.
struct Asked {
  Configuration configuration;
  std::string folder;
};

/// "policy:FOLDER" is every policy of the folder, by name; everything else is itself.
std::vector<std::string> files_of(const std::string& planner) {
  constexpr std::string_view kPolicy = "policy:";
  if (!planner.starts_with(kPolicy)) return {planner};
  const std::string folder = planner.substr(kPolicy.size());
  if (!fs::is_directory(folder)) return {planner};
  std::vector<std::string> policies;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".safetensors") continue;
    policies.push_back(std::string(kPolicy) + entry.path().string());
  }
  if (policies.empty()) {
    throw ScenarioError({}, fmt::format("--planner: '{}' has no policy", planner),
                        "name a file, or a folder with one *.safetensors per training seed");
  }
  std::sort(policies.begin(), policies.end());
  return policies;
}

/// The planners that the options name, each once, with the allocator of `base`; its own by default.
std::vector<Asked> planners_of(const std::vector<std::string>& lists, const Configuration& base) {
  std::vector<Asked> all;
  for (const std::string& list : lists) {
    for (const std::string& planner : split_planners(list)) {
      if (planner == "replay") {
        throw ScenarioError({}, "planner 'replay' is only for simulate",
                            "use simulate --planner replay --decisions FILE");
      }
      for (const std::string& file : files_of(planner)) {
        if (std::any_of(all.begin(), all.end(),
                        [&](const Asked& other) { return other.configuration.planner == file; })) {
          throw ScenarioError({}, fmt::format("--planner: '{}' is listed twice", file),
                              "list each planner once");
        }
        all.push_back({base, file == planner ? "" : planner});
        all.back().configuration.planner = file;
      }
    }
  }
  if (all.empty()) all.push_back({base, ""});
  return all;
}

/// What is to be evaluated: every planner with every allocator, or two with --versus. Throws
/// ScenarioError for names that are unknown or listed twice: before the first run, which may take
/// long.
std::vector<Asked> configurations_of(const EvaluateArguments& arguments) {
  const std::vector<Asked> planners = planners_of(arguments.planners, arguments.run.configuration);
  const std::vector<std::string> allocators = allocators_of(arguments.run.configuration.allocator);
  std::vector<Asked> configurations;
  for (const Asked& planner : planners) {
    for (const std::string& allocator : allocators) {
      configurations.push_back(planner);
      configurations.back().configuration.allocator = allocator;
    }
  }
  if (arguments.versus.empty()) return configurations;
  const auto refuse_list = [](const char* option, std::size_t count) {
    throw ScenarioError(
        {}, fmt::format("--versus compares two configurations, but {} lists {}", option, count),
        fmt::format("leave out --versus, or name one {}", option + 2));
  };
  if (planners.size() > 1) refuse_list("--planner", planners.size());
  if (allocators.size() > 1) refuse_list("--allocator", allocators.size());
  configurations.push_back({parse_versus(arguments.versus, configurations[0].configuration), ""});
  return configurations;
}

/// A planner that cannot be made is an error before the first run.
void try_planners(const Scenario& scenario, const std::vector<Asked>& configurations) {
  const Simulator simulator(std::make_shared<const LineModel>(scenario.line));
  for (const auto& [configuration, folder] : configurations) {
    static_cast<void>(PlannerRegistry::make(configuration.planner, simulator,
                                            planner_context(scenario, configuration.allocator)));
  }
}

void add_plan(const EvaluateArguments& arguments, const LineModel& line, Json& object) {
  object["line"] = line.name;
  object["trials"] = arguments.trials;
  object["seed"] = arguments.run.seed;
}

/// One configuration, or two with --versus.
void show(const EvaluateArguments& arguments, const LineModel& line,
          const std::vector<Evaluation>& evaluations) {
  const bool paired = evaluations.size() > 1;
  if (arguments.run.json) {
    Json object = evaluation_json(line, evaluations.at(0));
    add_plan(arguments, line, object);
    if (paired) {
      object["versus"] = evaluation_json(line, evaluations[1]);
      object["paired"] = paired_json(line, evaluations[0], evaluations[1]);
    }
    print(object.dump(2) + "\n");
    return;
  }
  for (const Evaluation& evaluation : evaluations) {
    if (evaluation.rows.empty()) continue;  // interrupted before the first crew was complete
    if (&evaluation != &evaluations[0]) print("\n");
    print(evaluation_text(line, evaluation));
    print(shield_text(evaluation));
    if (arguments.utilisation) print(utilisation_text(line, evaluation));
  }
  if (paired) print(paired_text(line, evaluations[0], evaluations[1]));
}

/// Several configurations, all that are complete of those that were asked for.
void show_several(const EvaluateArguments& arguments, const LineModel& line,
                  const std::vector<Evaluation>& evaluations, const std::vector<Asked>& asked) {
  const std::string& planner = asked[0].configuration.planner;
  const bool planners = std::any_of(asked.begin(), asked.end(), [&](const Asked& other) {
    return other.configuration.planner != planner;
  });
  if (arguments.run.json) {
    Json object = Json::object();
    if (!planners) object["planner"] = planner;
    add_plan(arguments, line, object);
    object.update(planners && !evaluations.empty() ? planners_json(line, evaluations)
                                                   : allocators_json(line, evaluations));
    if (!seed_groups(evaluations).empty()) object["seeds"] = seeds_json(line, evaluations);
    print(object.dump(2) + "\n");
    return;
  }
  if (evaluations.empty()) return;
  print(planners ? planners_text(line, evaluations) : allocators_text(line, evaluations));
  print(seeds_text(line, evaluations));
  for (const Evaluation& evaluation : evaluations) {
    if (!arguments.utilisation) break;
    print(fmt::format("\n{}\n", name_of(evaluation.configuration)) +
          utilisation_text(line, evaluation));
  }
}

int evaluate(const EvaluateArguments& arguments) {
  const std::vector<Asked> configurations = configurations_of(arguments);
  const Scenario scenario = load(arguments.run.scenario);
  const LineModel& line = scenario.line;
  try_planners(scenario, configurations);
  const TrialPlan plan{.crews = crews_of(arguments.run, line, true),
                       .trials = arguments.trials,
                       .seed = arguments.run.seed,
                       .threads = arguments.threads,
                       .now_ns = clock_ns};
  std::vector<Evaluation> evaluations;
  for (const auto& [configuration, folder] : configurations) {
    if (interrupted().requested()) break;
    evaluations.push_back(evaluate_one(scenario, configuration, plan));
    evaluations.back().folder = folder;
  }
  const bool several = configurations.size() > 1 && arguments.versus.empty();
  if (several) {
    // Interrupted: means over different crews could not be compared.
    std::erase_if(evaluations, [&](const Evaluation& evaluation) {
      return evaluation.rows.size() < plan.crews.size();
    });
    show_several(arguments, line, evaluations, configurations);
  } else if (!evaluations.empty()) {
    show(arguments, line, evaluations);
  }
  if (!arguments.csv.empty()) write_file(arguments.csv, evaluation_csv(line, evaluations, several));
  if (interrupted().requested()) {
    report(several ? "interrupted: only the configurations whose trials were complete are shown"
                   : "interrupted: only the crews whose trials were complete are shown");
    return kInterrupted;
  }
  return kOk;
}

}  // namespace

Command add_evaluate(CLI::App& app) {
  auto arguments = std::make_shared<EvaluateArguments>();
  add_scenario_option(app, arguments->run);
  add_run_options(app, arguments->run);
  app.get_option("--humans")
      ->description("Numbers of workers of kind 'human': 2, 1..3 or 1,3")
      ->type_name("N..M");
  app.get_option("--robots")
      ->description("Numbers of workers of kind 'robot': 2, 1..3 or 1,3")
      ->type_name("N..M");
  add_configuration_options(app, arguments->run);
  app.get_option("--allocator")
      ->description(app.get_option("--allocator")->get_description() +
                    "; several with commas are compared")
      ->type_name("NAME,...");
  const std::string who = app.get_option("--planner")->get_description();
  app.remove_option(app.get_option("--planner"));
  app.add_option(
         "--planner", arguments->planners,
         who +
             "; several with commas, or the option again, are compared, and of policy:FOLDER "
             "all policies, as training seeds of one algorithm (default: first)")
      ->type_name("NAME,...")
      ->allow_extra_args(false);
  add_shield_option(app, arguments->run);
  add_close_option(app, arguments->run);
  app.add_option("--trials", arguments->trials, "Runs per crew, each from other start positions")
      ->capture_default_str()
      ->check(CLI::Range(std::size_t{1}, std::size_t{10'000'000}))
      ->type_name("N");
  app.add_option("--threads", arguments->threads,
                 "Threads; 0: one per core. Results do not depend on it")
      ->capture_default_str()
      ->check(CLI::Range(std::size_t{0}, std::size_t{1024}))
      ->type_name("N");
  app.add_option("--versus", arguments->versus,
                 "A second configuration, compared trial by trial: PLANNER, PLANNER+ALLOCATOR or "
                 "+ALLOCATOR")
      ->type_name("SPEC");
  app.add_flag("--utilisation", arguments->utilisation,
               "Also print what every worker and machine was busy with");
  app.add_option("--csv", arguments->csv, "Write the rows here")->type_name("FILE.csv");
  app.footer(
      "Failed runs count with the horizon as their makespan; success and progress stand beside.\n"
      "Examples:\n  linewright evaluate scenarios/duct_line.yaml --planner first --humans 1..3 "
      "--robots 1..3 --trials 100 --versus +no_spatial\n"
      "  linewright evaluate scenarios/duct_line.yaml --allocator sap,no_spatial,longest_path\n"
      "  linewright evaluate scenarios/duct_line.yaml --planner "
      "first,priority:tuned,lookahead:1ms");
  return [arguments] { return evaluate(*arguments); };
}

}  // namespace linewright::cli
