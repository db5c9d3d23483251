#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "linewright/base/cancel.hpp"
#include "linewright/evaluation/crews.hpp"
#include "linewright/evaluation/trials.hpp"
#include "linewright/planning/planner.hpp"
#include "linewright/scenario/scenario.hpp"
#include "linewright/simulation/run_setup.hpp"

namespace linewright::cli {

/// What the process returns; documented in docs/cli.md.
enum ExitCode : int {
  kOk = 0,
  kFound = 1,          ///< `check --strict` found something
  kBadInput = 2,       ///< a file, an option or a value is wrong; nothing was written
  kInternalError = 3,  ///< a defect of linewright
  kInterrupted = 130,  ///< Ctrl-C; what was complete has been printed
};

/// Set by Ctrl-C (SIGINT) and SIGTERM.
CancelToken& interrupted();

/// A subcommand's work, to be run after all options have been parsed.
using Command = std::function<int()>;

/// The options that say which line is run with whom.
struct RunArguments {
  std::string scenario;
  std::string humans;  ///< "2", "1..3", "1,3"; empty: the scenario's
  std::string robots;
  std::vector<std::string> crew;  ///< "KIND=2", for any kind of worker
  std::optional<std::int32_t> order;
  std::optional<Tick> horizon;
  std::vector<std::string> close;  ///< "ZONE@TICK+TICKS"
  std::uint64_t seed = 1;
  Configuration configuration;
  bool json = false;
};

void add_scenario_option(CLI::App& app, RunArguments& arguments);
void add_run_options(CLI::App& app, RunArguments& arguments);
void add_configuration_options(CLI::App& app, RunArguments& arguments);
/// Sets Configuration::shield: on unless told otherwise.
void add_shield_option(CLI::App& app, RunArguments& arguments);
void add_close_option(CLI::App& app, RunArguments& arguments);

/// The allocators of a comma list. Throws ScenarioError for names that are unknown or listed twice.
[[nodiscard]] std::vector<std::string> allocators_of(std::string_view list);

/// The closures that --close names. Throws ScenarioError for unknown zones and bad ticks.
[[nodiscard]] std::vector<Closure> closures_of(const RunArguments& arguments,
                                               const LineModel& line);

/// The crews that the options name: every combination of the counts, in order; the first kind
/// varies slowest. Kinds that are not named keep the scenario's count (none in the RunOptions)
/// unless `fill` is set: then their whole range is run through. Throws ScenarioError for unknown
/// kinds and bad counts.
[[nodiscard]] std::vector<RunOptions> crews_of(const RunArguments& arguments, const LineModel& line,
                                               bool fill);

/// The one crew that the options name, for commands that run a single one. Throws ScenarioError
/// when they name several.
[[nodiscard]] RunOptions one_crew(const RunArguments& arguments, const LineModel& line);

/// Loads a scenario for a command: shows progress while routes are planned, stops at Ctrl-C, and
/// prints what is odd about the scenario.
[[nodiscard]] Scenario load(const std::string& file, bool route_cache = true);

/// Nanoseconds of a clock that never goes back.
[[nodiscard]] std::int64_t clock_ns();

/// The time that `--budget` gives: "500ms", "60s", "5min". Throws ScenarioError for anything else
/// and for times that leave nothing.
[[nodiscard]] std::int64_t parse_budget_ns(std::string_view text);

/// What planners of a command may use. With a clock, and stopped by Ctrl-C.
[[nodiscard]] PlannerContext planner_context(const Scenario& scenario,
                                             const std::string& allocator);

/// Prints results to standard output; a closed pipe is not an error.
void print(const std::string& text);

/// Prints everything else to standard error.
void report(const std::string& text);

/// A progress bar on standard error, only when a person watches it.
class ProgressBar {
 public:
  explicit ProgressBar(std::string what);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// `note`: what else to say, behind the numbers.
  void update(std::size_t done, std::size_t total, const std::string& note = {});

 private:
  std::string what_;
  bool shown_;
  std::int64_t started_ms_;
  std::int64_t drawn_ms_ = 0;
};

/// A plain-text table: the first column left, the others right aligned.
[[nodiscard]] std::string text_table(const std::vector<std::vector<std::string>>& rows);

/// "12 %", or with decimals.
[[nodiscard]] std::string percent(double share, int decimals = 0);

Command add_check(CLI::App& app);
Command add_simulate(CLI::App& app);
Command add_evaluate(CLI::App& app);
Command add_gantt(CLI::App& app);
Command add_map(CLI::App& app);
Command add_routes(CLI::App& app);
Command add_bench(CLI::App& app);
Command add_bound(CLI::App& app);
Command add_schema(CLI::App& app);
Command add_train(CLI::App& app);
Command add_tune_priority(CLI::App& app);
Command add_solve(CLI::App& app);
Command add_reproduce(CLI::App& app);
Command add_view(CLI::App& app);

/// Becomes the trainer, a program of its own because LibTorch costs 0.4 s at every start.
/// `arguments`: those of the command line from the word `train` on. Throws ScenarioError when there
/// is none.
[[noreturn]] void start_trainer(char** arguments);

}  // namespace linewright::cli
