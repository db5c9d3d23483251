#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <exception>
#include <string>
#include <utility>
#include <vector>

#include "common.hpp"
#include "linewright/base/diagnostic.hpp"
#include "linewright_commit.hpp"

namespace {

void on_signal(int signal) {
  // A second Ctrl-C ends the program at once.
  std::signal(signal, SIG_DFL);
  linewright::cli::interrupted().request();
}

int run(const std::vector<std::pair<CLI::App*, linewright::cli::Command>>& commands) {
  for (const auto& [app, command] : commands) {
    if (app->parsed()) return command();
  }
  return linewright::cli::kOk;
}

/// CLI11 would only say that a subcommand is missing.
void refuse_unknown(int argc, char** argv,
                    const std::vector<std::pair<CLI::App*, linewright::cli::Command>>& commands) {
  if (argc < 2 || argv[1][0] == '-') return;
  std::vector<std::string> names;
  for (const auto& command : commands) names.push_back(command.first->get_name());
  if (std::find(names.begin(), names.end(), argv[1]) != names.end()) return;
  throw linewright::ScenarioError(
      {}, fmt::format("there is no command '{}'", argv[1]),
      linewright::name_hint(argv[1], names) + "; linewright --help shows them");
}

/// For every option on the command line that the command does not have: the nearest one it has.
void suggest_options(int argc, char** argv,
                     const std::vector<std::pair<CLI::App*, linewright::cli::Command>>& commands) {
  for (const auto& [app, command] : commands) {
    if (argc < 2 || app->get_name() != argv[1]) continue;
    std::vector<std::string> names;
    for (const CLI::Option* option : app->get_options()) {
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    }
    for (int i = 2; i < argc; ++i) {
      const std::string word = std::string(argv[i]).substr(0, std::string(argv[i]).find('='));
      if (!word.starts_with("--") || std::find(names.begin(), names.end(), word) != names.end())
        continue;
      linewright::cli::report(fmt::format("{}: {}", word, linewright::name_hint(word, names)));
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  using namespace linewright;
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  std::signal(SIGPIPE, SIG_IGN);

  CLI::App app(
      "Plans, allocates and simulates production lines of people, robots and machines.\n"
      "Start with: linewright simulate scenarios/duct_line.yaml --humans 2 --robots 2");
  app.name("linewright");
  app.set_version_flag("--version", "linewright " LINEWRIGHT_VERSION " (" LINEWRIGHT_COMMIT ")");
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 done, 1 check --strict found something, 2 bad input, 3 internal error, "
      "130 interrupted.\nStandard output carries results, standard error everything else.");
  const std::vector<std::pair<const char*, const char*>> subcommands{
      {"simulate", "Run one production order: summary, event log, Gantt chart"},
      {"evaluate", "Many runs over crews and start positions: makespan, success, distance"},
      {"check", "Everything that is wrong with a scenario, and dead states of the line"},
      {"gantt", "Draw the Gantt chart of an event log"},
      {"view", "See event logs in a browser: the hall, the Gantt chart, comparisons"},
      {"map", "Facts of a scenario's map; write it for ROS map_server"},
      {"routes", "Routes between all stations: lengths, failures, time of planning, picture"},
      {"bench", "Measure the simulator's speed and fingerprint its behaviour"},
      {"bound", "How fast an order can be made at best, whoever plans: lower bounds"},
      {"schema", "Print the JSON Schema of scenario files"},
      {"train", "Train a policy for a line (needs LibTorch)"},
      {"reproduce", "Run experiments and write their tables: `reproduce paper`"},
      {"solve", "Search for the best schedule from one start, off-line"},
      {"tune-priority", "Find the best fixed order of the tasks (planner priority:tuned)"}};
  linewright::cli::Command (*const add[])(CLI::App&) = {
      cli::add_simulate, cli::add_evaluate,  cli::add_check, cli::add_gantt,        cli::add_view,
      cli::add_map,      cli::add_routes,    cli::add_bench, cli::add_bound,        cli::add_schema,
      cli::add_train,    cli::add_reproduce, cli::add_solve, cli::add_tune_priority};
  std::vector<std::pair<CLI::App*, cli::Command>> commands;
  for (std::size_t i = 0; i < subcommands.size(); ++i) {
    CLI::App* sub = app.add_subcommand(subcommands[i].first, subcommands[i].second);
    commands.emplace_back(sub, add[i](*sub));
  }
  try {
    refuse_unknown(argc, argv, commands);
    if (argc >= 2 && std::string(argv[1]) == "train") cli::start_trainer(argv + 1);
    app.parse(argc, argv);
    return run(commands);
  } catch (const CLI::ParseError& error) {
    if (app.exit(error) == 0) return cli::kOk;  // --help and --version come here, too
    suggest_options(argc, argv, commands);
    return cli::kBadInput;
  } catch (const ScenarioError& error) {
    cli::report(error.what());
    return cli::interrupted().requested() ? cli::kInterrupted : cli::kBadInput;
  } catch (const std::exception& error) {
    cli::report(fmt::format("internal error: {}\nThis is a defect of linewright; please report it.",
                            error.what()));
    return cli::kInternalError;
  }
}
