#include "linewright/planning/tune_priority.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "common.hpp"
#include "linewright/allocation/allocator.hpp"
#include "linewright/base/diagnostic.hpp"
#include "linewright/base/files.hpp"
#include "linewright/planning/priority_file.hpp"

namespace linewright::cli {
namespace {

using Json = nlohmann::ordered_json;

struct TuneArguments {
  RunArguments run;
  std::size_t starts = 50;
  std::size_t runs = 300'000;
  bool all = false;
  std::size_t threads = 0;
  std::string out;
};

std::string list_of(const LineModel& line, const std::vector<TaskId>& order) {
  std::string list;
  for (const TaskId task : order) {
    list += fmt::format("{}{}", list.empty() ? "" : ",", line.tasks[task.index()].number);
  }
  return list;
}

PriorityEntry tune(const TuneArguments& arguments, const Simulator& simulator,
                   const std::string& allocator) {
  ProgressBar bar("tune-priority for " + allocator);
  TuneOptions options{.crews = crews_of(arguments.run, simulator.line(), true),
                      .allocator = allocator,
                      .starts = arguments.starts,
                      .most_runs = arguments.runs,
                      .seed = arguments.run.seed,
                      .threads = arguments.threads,
                      .cancel = &interrupted(),
                      .progress = {}};
  // Of all orders, most of the runs are those of the first round: each crew once.
  const std::size_t runs =
      arguments.all ? orders_of(simulator.line()) * options.crews.size() : arguments.runs;
  options.progress = [&](const TunedPriority& best) {
    bar.update(std::min(best.runs, runs), runs,
               best.makespan > 0.0 ? fmt::format("best {:.1f}", best.makespan) : "");
  };
  return {.allocator = allocator,
          .tuned = arguments.all ? try_all_orders(simulator, options)
                                 : tune_priority(simulator, options)};
}

std::string to_text(const LineModel& line, const std::vector<PriorityEntry>& entries,
                    const std::string& file) {
  std::vector<std::vector<std::string>> rows{
      {"allocator", "priority", "mean makespan", "success", "runs"}};
  for (const PriorityEntry& entry : entries) {
    rows.push_back({entry.allocator, list_of(line, entry.tuned.order),
                    fmt::format("{:.2f}", entry.tuned.makespan),
                    fmt::format("{:.3f}", entry.tuned.success_rate),
                    std::to_string(entry.tuned.runs)});
  }
  return text_table(rows) + "written to " + file + "\n";
}

Json to_json(const LineModel& line, const std::vector<PriorityEntry>& entries,
             const std::string& file) {
  Json object{{"line", line.name}, {"orders", Json::array()}, {"file", file}};
  for (const PriorityEntry& entry : entries) {
    object["orders"].push_back({{"allocator", entry.allocator},
                                {"priority", list_of(line, entry.tuned.order)},
                                {"mean_makespan", entry.tuned.makespan},
                                {"success_rate", entry.tuned.success_rate},
                                {"runs", entry.tuned.runs}});
  }
  return object;
}

int tune_command(const TuneArguments& arguments) {
  const std::vector<std::string> allocators = allocators_of(arguments.run.configuration.allocator);
  const Scenario scenario = load(arguments.run.scenario);
  const Simulator simulator(std::make_shared<const LineModel>(scenario.line));
  std::vector<PriorityEntry> entries;
  for (const std::string& allocator : allocators) {
    if (entries.empty() || !interrupted().requested()) {
      entries.push_back(tune(arguments, simulator, allocator));
    }
  }
  std::erase_if(entries, [](const PriorityEntry& e) { return e.tuned.makespan <= 0.0; });
  if (entries.empty()) {
    report("interrupted before the first round was over: no order is known, nothing is written");
    return kInterrupted;
  }
  const std::string file = arguments.out.empty() ? priority_file_of(scenario.file) : arguments.out;
  write_file(file, priority_text(scenario.line, scenario.content_hash, entries));
  print(arguments.run.json ? to_json(scenario.line, entries, file).dump(2) + "\n"
                           : to_text(scenario.line, entries, file));
  if (!interrupted().requested()) return kOk;
  report("interrupted: these are the best orders so far");
  return kInterrupted;
}

}  // namespace

Command add_tune_priority(CLI::App& app) {
  auto arguments = std::make_shared<TuneArguments>();
  arguments->run.configuration.allocator = "sap,first_idle";
  add_scenario_option(app, arguments->run);
  add_run_options(app, arguments->run);
  app.add_option(
         "--allocator", arguments->run.configuration.allocator,
         fmt::format("Who chooses the people and robots: {}; with several, an order for each",
                     fmt::join(allocator_names(), ", ")))
      ->capture_default_str()
      ->type_name("NAME,...");
  add_close_option(app, arguments->run);
  app.add_option("--starts", arguments->starts, "Start positions per crew that orders are tried on")
      ->capture_default_str()
      ->check(CLI::Range(std::size_t{1}, std::size_t{100'000}))
      ->type_name("N");
  auto* runs = app.add_option("--runs", arguments->runs,
                              "Simulated runs after which the search ends, per allocator")
                   ->capture_default_str()
                   ->check(CLI::Range(std::size_t{1}, std::size_t{1'000'000'000}))
                   ->type_name("N");
  app.add_flag("--exhaustive", arguments->all,
               "Instead of a search: try every order (at most 9 tasks; minutes)")
      ->excludes(runs);
  app.add_option("--threads", arguments->threads,
                 "Threads; 0: one per core. The result does not depend on it")
      ->capture_default_str()
      ->check(CLI::Range(std::size_t{0}, std::size_t{1024}))
      ->type_name("N");
  app.add_option("--out", arguments->out,
                 "Write the order here (default: beside the scenario, where priority:tuned looks)")
      ->type_name("FILE.priority");
  app.footer(
      "Finds the fixed order of all tasks with the lowest mean makespan over all crews. Ctrl-C "
      "keeps the best so far.\nExample:\n  linewright tune-priority scenarios/duct_line.yaml\n  "
      "linewright evaluate scenarios/duct_line.yaml --planner priority:tuned");
  return [arguments] { return tune_command(*arguments); };
}

}  // namespace linewright::cli
