#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string_view>

#include "common.hpp"
#include "linewright/base/diagnostic.hpp"
#include "linewright/base/files.hpp"
#include "linewright/evaluation/event_log_writer.hpp"
#include "linewright/scenario/load.hpp"

namespace linewright::cli {
namespace {

using Json = nlohmann::ordered_json;

struct EvaluateArguments {
  RunArguments run;
  std::size_t trials = 100;
  std::size_t threads = 0;
  std::string csv;
  std::string versus;
  bool utilisation = false;
};

/// Results of one configuration: by crew, and over all.
struct Evaluation {
  Configuration configuration;
  std::vector<std::vector<TrialResult>> trials;
  std::vector<TrialSummary> rows;

  [[nodiscard]] double mean(double (*value)(const TrialSummary&)) const {
    double sum = 0.0;
    for (const TrialSummary& row : rows) sum += value(row);
    return rows.empty() ? 0.0 : sum / static_cast<double>(rows.size());
  }
  [[nodiscard]] double makespan() const {
    return mean([](const TrialSummary& row) { return row.makespan.mean; });
  }
  [[nodiscard]] double success_rate() const {
    return mean([](const TrialSummary& row) { return row.success_rate; });
  }
  [[nodiscard]] double progress() const {
    return mean([](const TrialSummary& row) { return row.progress; });
  }
};

/// "PLANNER", "PLANNER+ALLOCATOR" or "+ALLOCATOR"; what is missing is as in `base`.
Configuration parse_versus(const std::string& text, const Configuration& base) {
  Configuration configuration = base;
  const std::size_t plus = text.find('+');
  if (plus != 0) configuration.planner = text.substr(0, plus);
  if (plus != std::string::npos) configuration.allocator = text.substr(plus + 1);
  return configuration;
}

std::string name_of(const Configuration& configuration) {
  return configuration.planner + "+" + configuration.allocator;
}

Evaluation evaluate_one(const Scenario& scenario, const Configuration& configuration,
                        const TrialPlan& plan) {
  Evaluation evaluation{.configuration = configuration, .trials = {}, .rows = {}};
  ProgressBar bar(name_of(configuration));
  evaluation.trials = run_trials(
      scenario, configuration, plan,
      [&](std::size_t done, std::size_t total) { bar.update(done, total); }, &interrupted());
  for (std::size_t c = 0; c < evaluation.trials.size(); ++c) {
    evaluation.rows.push_back(summarize(evaluation.trials[c], plan.crews[c]));
  }
  return evaluation;
}

Json spread_json(const Spread& spread) {
  return {{"mean", spread.mean}, {"sd", spread.sd}, {"ci95", spread.ci95}};
}

Json row_json(const LineModel& line, const TrialSummary& row) {
  Json object{{"crew", crew_name(line, row.crew)}};
  for (std::size_t k = 0; k < row.crew.size(); ++k) {
    object[line.worker_kinds[k].name + "s"] = row.crew[k];
  }
  object["makespan"] = spread_json(row.makespan);
  object["success_rate"] = row.success_rate;
  object["progress"] = row.progress;
  object["distance"] = {{"metres", spread_json(row.distance_m)},
                        {"ticks", spread_json(row.distance_ticks)}};
  object["decisions"] = row.decisions;
  object["workers"] = Json::array();
  std::size_t id = 0;
  for (std::size_t k = 0; k < row.crew.size(); ++k) {
    for (std::int32_t i = 0; i < row.crew[k]; ++i, ++id) {
      const WorkerShares& shares = row.workers[id];
      object["workers"].push_back({{"id", fmt::format("{}.{}", line.worker_kinds[k].name, i)},
                                   {"work", shares.work},
                                   {"travel", shares.travel},
                                   {"wait", shares.wait},
                                   {"idle", shares.idle}});
    }
  }
  object["machines"] = Json::object();
  for (std::size_t m = 0; m < row.machines.size(); ++m)
    object["machines"][line.machines[m].name] = row.machines[m];
  return object;
}

Json evaluation_json(const LineModel& line, const Evaluation& evaluation) {
  Json object{{"planner", evaluation.configuration.planner},
              {"allocator", evaluation.configuration.allocator},
              {"rows", Json::array()}};
  for (const TrialSummary& row : evaluation.rows) object["rows"].push_back(row_json(line, row));
  object["mean_makespan"] = evaluation.makespan();
  object["success_rate"] = evaluation.success_rate();
  object["progress"] = evaluation.progress();
  return object;
}

PairedComparison compare_all(const Evaluation& first, const Evaluation& second) {
  std::vector<TrialResult> a;
  std::vector<TrialResult> b;
  for (std::size_t c = 0; c < second.trials.size(); ++c) {
    a.insert(a.end(), first.trials[c].begin(), first.trials[c].end());
    b.insert(b.end(), second.trials[c].begin(), second.trials[c].end());
  }
  return compare_paired(a, b);
}

Json paired_json(const PairedComparison& comparison) {
  return {{"difference", spread_json(comparison.difference)},
          {"faster", comparison.faster},
          {"equal", comparison.equal},
          {"slower", comparison.slower}};
}

std::string percent(double share) { return fmt::format("{:.0f} %", share * 100.0); }

std::string table_of(const LineModel& line, const Evaluation& evaluation) {
  std::vector<std::vector<std::string>> rows{
      {"crew", "makespan", "ci95", "sd", "success", "progress", "metres", "ticks", "decisions"}};
  const auto add = [&](std::string crew, const TrialSummary& row) {
    rows.push_back({std::move(crew), fmt::format("{:.2f}", row.makespan.mean),
                    fmt::format("{:.2f}", row.makespan.ci95),
                    fmt::format("{:.2f}", row.makespan.sd), fmt::format("{:.3f}", row.success_rate),
                    fmt::format("{:.3f}", row.progress), fmt::format("{:.0f}", row.distance_m.mean),
                    fmt::format("{:.0f}", row.distance_ticks.mean),
                    fmt::format("{:.1f}", row.decisions)});
  };
  for (const TrialSummary& row : evaluation.rows) add(crew_name(line, row.crew), row);
  rows.push_back(
      {"mean", fmt::format("{:.2f}", evaluation.makespan()), "", "",
       fmt::format("{:.3f}", evaluation.success_rate()),
       fmt::format("{:.3f}", evaluation.progress()),
       fmt::format("{:.0f}",
                   evaluation.mean([](const TrialSummary& r) { return r.distance_m.mean; })),
       fmt::format("{:.0f}",
                   evaluation.mean([](const TrialSummary& r) { return r.distance_ticks.mean; })),
       fmt::format("{:.1f}", evaluation.mean([](const TrialSummary& r) { return r.decisions; }))});
  return text_table(rows);
}

std::string utilisation_of(const LineModel& line, const Evaluation& evaluation) {
  std::string text;
  for (const TrialSummary& row : evaluation.rows) {
    std::vector<std::vector<std::string>> rows{
        {crew_name(line, row.crew), "work", "travel", "wait", "idle"}};
    std::size_t id = 0;
    for (std::size_t k = 0; k < row.crew.size(); ++k) {
      for (std::int32_t i = 0; i < row.crew[k]; ++i, ++id) {
        const WorkerShares& shares = row.workers[id];
        rows.push_back({fmt::format("{}.{}", line.worker_kinds[k].name, i), percent(shares.work),
                        percent(shares.travel), percent(shares.wait), percent(shares.idle)});
      }
    }
    for (std::size_t m = 0; m < row.machines.size(); ++m) {
      rows.push_back({line.machines[m].name, percent(row.machines[m])});
    }
    text += "\n" + text_table(rows);
  }
  return text;
}

std::string csv_of(const LineModel& line, const std::vector<Evaluation>& evaluations) {
  std::string text = "planner,allocator,crew";
  for (const WorkerKind& kind : line.worker_kinds) text += "," + kind.name + "s";
  text +=
      ",trials,makespan_mean,makespan_sd,makespan_ci95,success_rate,progress,distance_m_mean,"
      "distance_ticks_mean,decisions_mean\n";
  for (const Evaluation& evaluation : evaluations) {
    for (const TrialSummary& row : evaluation.rows) {
      text += fmt::format("\"{}\",{},{}", evaluation.configuration.planner,
                          evaluation.configuration.allocator, crew_name(line, row.crew));
      for (const std::int32_t count : row.crew) text += fmt::format(",{}", count);
      text += fmt::format(",{},{},{},{},{},{},{},{},{}\n", row.makespan.count, row.makespan.mean,
                          row.makespan.sd, row.makespan.ci95, row.success_rate, row.progress,
                          row.distance_m.mean, row.distance_ticks.mean, row.decisions);
    }
  }
  return text;
}

std::string paired_text(const LineModel& line, const Evaluation& first, const Evaluation& second) {
  std::vector<std::vector<std::string>> rows{
      {"crew", "difference", "ci95", "faster", "equal", "slower"}};
  const auto add = [&](std::string crew, const PairedComparison& c) {
    rows.push_back({std::move(crew), fmt::format("{:+.2f}", c.difference.mean),
                    fmt::format("{:.2f}", c.difference.ci95), std::to_string(c.faster),
                    std::to_string(c.equal), std::to_string(c.slower)});
  };
  for (std::size_t c = 0; c < second.trials.size(); ++c) {
    add(crew_name(line, second.rows[c].crew), compare_paired(first.trials[c], second.trials[c]));
  }
  add("all", compare_all(first, second));
  return fmt::format("\n{} minus {}, ticks of makespan, trial by trial from the same starts\n",
                     name_of(second.configuration), name_of(first.configuration)) +
         text_table(rows);
}

int evaluate(const EvaluateArguments& arguments) {
  if (arguments.run.configuration.planner == "replay") {
    throw ScenarioError({}, "planner 'replay' is only for simulate",
                        "use simulate --planner replay --decisions FILE");
  }
  const Scenario scenario = load_scenario(arguments.run.scenario);
  const LineModel& line = scenario.line;
  TrialPlan plan{.crews = crews_of(arguments.run, line, true),
                 .trials = arguments.trials,
                 .seed = arguments.run.seed,
                 .threads = arguments.threads};
  std::vector<Configuration> configurations{arguments.run.configuration};
  if (!arguments.versus.empty()) {
    configurations.push_back(parse_versus(arguments.versus, configurations[0]));
  }
  std::vector<Evaluation> evaluations;
  for (const Configuration& configuration : configurations) {
    if (!interrupted().requested())
      evaluations.push_back(evaluate_one(scenario, configuration, plan));
  }
  const bool paired = evaluations.size() > 1;
  if (arguments.run.json) {
    Json object = evaluation_json(line, evaluations[0]);
    object["line"] = line.name;
    object["trials"] = arguments.trials;
    object["seed"] = arguments.run.seed;
    if (paired) {
      object["versus"] = evaluation_json(line, evaluations[1]);
      object["paired"] = paired_json(compare_all(evaluations[0], evaluations[1]));
      object["paired"]["rows"] = Json::array();
      for (std::size_t c = 0; c < evaluations[1].trials.size(); ++c) {
        Json row = paired_json(compare_paired(evaluations[0].trials[c], evaluations[1].trials[c]));
        row["crew"] = crew_name(line, evaluations[1].rows[c].crew);
        object["paired"]["rows"].push_back(std::move(row));
      }
    }
    print(object.dump(2) + "\n");
  } else {
    for (const Evaluation& evaluation : evaluations) {
      if (evaluation.rows.empty()) continue;  // interrupted before the first crew was complete
      print(fmt::format("{}{}, {}: {} trials per crew\n",
                        &evaluation == &evaluations[0] ? "" : "\n", line.name,
                        name_of(evaluation.configuration), arguments.trials) +
            table_of(line, evaluation) +
            (arguments.utilisation ? utilisation_of(line, evaluation) : std::string()));
    }
    if (paired) print(paired_text(line, evaluations[0], evaluations[1]));
  }
  if (!arguments.csv.empty()) write_file(arguments.csv, csv_of(line, evaluations));
  if (interrupted().requested()) {
    report("interrupted: only the crews whose trials were complete are shown");
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
      "Example:\n  linewright evaluate scenarios/duct_line.yaml --planner first --humans 1..3 "
      "--robots 1..3 --trials 100 --versus +no_spatial");
  return [arguments] { return evaluate(*arguments); };
}

}  // namespace linewright::cli
