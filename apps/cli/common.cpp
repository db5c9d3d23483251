#include "common.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <mutex>
#include <utility>

#include "linewright/allocation/allocator.hpp"
#include "linewright/base/diagnostic.hpp"
#include "linewright/planning/planner.hpp"
#include "linewright/scenario/load.hpp"

namespace linewright::cli {
namespace {

constexpr std::int32_t kMostOfAKind = 10'000;  // what scenarios allow
constexpr std::size_t kMostCrews = 10'000;     // of one command

std::int64_t now_ms() { return clock_ns() / 1'000'000; }

std::int32_t parse_count(const std::string& option, std::string_view text) {
  std::int32_t value = 0;
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value);
  if (parsed.ec != std::errc() || parsed.ptr != text.data() + text.size() || value < 0 ||
      value > kMostOfAKind) {
    throw ScenarioError(
        {}, fmt::format("{}: '{}' is no count", option, text),
        fmt::format("write a number up to {}, a range like 1..3 or a list like 1,3", kMostOfAKind));
  }
  return value;
}

std::vector<std::int32_t> parse_counts(const std::string& option, std::string_view text) {
  std::vector<std::int32_t> counts;
  do {
    const std::size_t comma = std::min(text.find(','), text.size());
    const std::string_view part = text.substr(0, comma);
    const std::size_t dots = part.find("..");
    const std::int32_t low = parse_count(option, part.substr(0, std::min(dots, part.size())));
    const std::int32_t high =
        dots == std::string_view::npos ? low : parse_count(option, part.substr(dots + 2));
    if (high < low) {
      throw ScenarioError({}, fmt::format("{}: the range '{}' is empty", option, part),
                          fmt::format("write {}..{}", high, low));
    }
    for (std::int32_t n = low; n <= high; ++n) counts.push_back(n);
    text.remove_prefix(std::min(comma + 1, text.size()));
  } while (!text.empty());
  return counts;
}

std::size_t kind_named(const LineModel& line, const std::string& option, const std::string& name) {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < line.worker_kinds.size(); ++k) {
    if (line.worker_kinds[k].name == name) return k;
    names.push_back(line.worker_kinds[k].name);
  }
  throw ScenarioError(
      {}, fmt::format("{}: line '{}' has no workers called '{}'", option, line.name, name),
      name_hint(name, names) + "; use --crew KIND=N");
}

}  // namespace

CancelToken& interrupted() {
  static CancelToken token;
  return token;
}

void add_scenario_option(CLI::App& app, RunArguments& arguments) {
  app.add_option("scenario", arguments.scenario, "Scenario file (docs/formats/scenario.md)")
      ->required()
      ->type_name("SCENARIO");
}

void add_run_options(CLI::App& app, RunArguments& arguments) {
  app.add_option("--humans", arguments.humans, "Number of workers of kind 'human'")->type_name("N");
  app.add_option("--robots", arguments.robots, "Number of workers of kind 'robot'")->type_name("N");
  app.add_option("--crew", arguments.crew, "Number of workers of any kind")
      ->type_name("KIND=N")
      ->delimiter(';');
  app.add_option("--order", arguments.order, "Quantity to produce (default: the scenario's)")
      ->type_name("N");
  app.add_option("--horizon", arguments.horizon,
                 "Ticks after which a run fails (default: the scenario's)")
      ->type_name("TICKS");
  app.add_option("--seed", arguments.seed, "Seed of start positions and of random choices")
      ->capture_default_str()
      ->check(CLI::NonNegativeNumber)
      ->type_name("N");
  app.add_flag("--json", arguments.json, "Print one JSON object (docs/cli.md) instead of text");
}

void add_configuration_options(CLI::App& app, RunArguments& arguments) {
  std::string planners;
  for (const auto& entry : PlannerRegistry::entries()) {
    planners += (planners.empty() ? "" : ", ") + entry.name;
    if (!entry.takes.empty()) planners += ":" + entry.takes;
  }
  app.add_option("--planner", arguments.configuration.planner, "Who chooses the task: " + planners)
      ->capture_default_str()
      ->type_name("NAME");
  app.add_option(
         "--allocator", arguments.configuration.allocator,
         fmt::format("Who chooses the people and robots: {}", fmt::join(allocator_names(), ", ")))
      ->capture_default_str()
      ->type_name("NAME");
}

std::vector<std::string> allocators_of(std::string_view list) {
  const auto& known = allocator_names();
  std::vector<std::string> names;
  while (true) {
    const std::size_t comma = std::min(list.find(','), list.size());
    const std::string name(list.substr(0, comma));
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      throw ScenarioError({}, fmt::format("unknown allocator '{}'", name), name_hint(name, known));
    }
    if (std::find(names.begin(), names.end(), name) != names.end()) {
      throw ScenarioError({}, fmt::format("--allocator: '{}' is listed twice", name),
                          "list each allocator once");
    }
    names.push_back(name);
    if (comma == list.size()) return names;
    list.remove_prefix(comma + 1);
  }
}

void add_shield_option(CLI::App& app, RunArguments& arguments) {
  arguments.configuration.shield = true;
  app.add_option_function<std::string>(
         "--shield",
         [&arguments](const std::string& value) { arguments.configuration.shield = value == "on"; },
         "Whether decisions after which the order cannot be finished are ruled out: on or off (as "
         "in the paper); default on")
      ->check(CLI::IsMember({"on", "off"}))
      ->type_name("on|off");
}

std::vector<RunOptions> crews_of(const RunArguments& arguments, const LineModel& line, bool fill) {
  std::vector<std::vector<std::int32_t>> counts(line.worker_kinds.size());
  const auto set = [&](const std::string& option, const std::string& kind,
                       const std::string& text) {
    if (text.empty()) return;
    std::vector<std::int32_t>& named = counts[kind_named(line, option, kind)];
    if (!named.empty()) {
      throw ScenarioError({}, fmt::format("{}: the number of {}s is given twice", option, kind),
                          "give it once");
    }
    named = parse_counts(option, text);
  };
  set("--humans", "human", arguments.humans);
  set("--robots", "robot", arguments.robots);
  for (const std::string& entry : arguments.crew) {
    const std::size_t equals = entry.find('=');
    if (equals == std::string::npos) {
      throw ScenarioError({}, fmt::format("--crew: '{}' is no KIND=N", entry),
                          "write --crew robot=2");
    }
    set("--crew", entry.substr(0, equals), entry.substr(equals + 1));
  }
  std::vector<RunOptions> crews{RunOptions{.workers = {},
                                           .order = arguments.order,
                                           .horizon = arguments.horizon,
                                           .closures = closures_of(arguments, line)}};
  for (std::size_t k = 0; k < counts.size(); ++k) {
    if (counts[k].empty() && fill) {
      for (std::int32_t n = line.worker_kinds[k].count.min; n <= line.worker_kinds[k].count.max;
           ++n) {
        counts[k].push_back(n);
      }
    }
    if (crews.size() * counts[k].size() > kMostCrews) {
      throw ScenarioError({}, fmt::format("these are more than {} crews", kMostCrews),
                          "name fewer numbers of workers, such as --crew KIND=1,100,10000");
    }
    std::vector<RunOptions> extended;
    for (const RunOptions& crew : crews) {
      if (counts[k].empty()) extended.push_back(crew);
      if (counts[k].empty()) extended.back().workers.emplace_back(std::nullopt);
      for (const std::int32_t n : counts[k]) {
        extended.push_back(crew);
        extended.back().workers.emplace_back(n);
      }
    }
    crews = std::move(extended);
  }
  return crews;
}

RunOptions one_crew(const RunArguments& arguments, const LineModel& line) {
  const std::vector<RunOptions> crews = crews_of(arguments, line, false);
  if (crews.size() > 1) {
    throw ScenarioError({},
                        fmt::format("{} crews are named, but this command runs one", crews.size()),
                        "give one number per kind of worker; evaluate and check take ranges");
  }
  return crews.at(0);
}

Scenario load(const std::string& file, bool route_cache) {
  ProgressBar bar("routes");
  std::mutex mutex;  // routes are planned by several threads
  LoadOptions options;
  options.route_cache = route_cache;
  options.cancel = &interrupted();
  options.progress = [&](std::size_t done, std::size_t total) {
    const std::scoped_lock lock(mutex);
    bar.update(done, total);
  };
  Scenario scenario = load_scenario(file, options);
  for (const Diagnostic& warning : scenario.warnings) report(to_string(warning));
  return scenario;
}

std::int64_t clock_ns() {
  using std::chrono::steady_clock;
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             steady_clock::now().time_since_epoch())
      .count();
}

std::int64_t parse_budget_ns(std::string_view text) {
  constexpr double kMost = 1e6;  // seconds
  double number = 0.0;
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), number);
  const std::string_view unit(parsed.ptr, text.data() + text.size());
  const double scale = unit == "ms" ? 1e-3 : unit == "s" ? 1.0 : unit == "min" ? 60.0 : 0.0;
  if (parsed.ec != std::errc() || scale == 0.0) {
    throw ScenarioError({}, fmt::format("--budget: {} is no time", in_quotes(text)),
                        "write 500ms, 60s or 5min");
  }
  if (!(number > 0.0) || number * scale > kMost) {
    throw ScenarioError({},
                        fmt::format("--budget: {} leaves nothing to search with, or is more than "
                                    "{:.0f} s",
                                    in_quotes(text), kMost),
                        "write a time above zero, such as 60s");
  }
  return std::max<std::int64_t>(1, static_cast<std::int64_t>(number * scale * 1e9));
}

PlannerContext planner_context(const Scenario& scenario, const std::string& allocator) {
  return {.allocator = allocator,
          .now_ns = clock_ns,
          .scenario_file = scenario.file,
          .scenario_hash = scenario.content_hash,
          .cancel = &interrupted()};
}

void print(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stdout);
  std::fflush(stdout);
}

void report(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fputc('\n', stderr);
}

ProgressBar::ProgressBar(std::string what)
    : what_(std::move(what)), shown_(isatty(STDERR_FILENO) == 1), started_ms_(now_ms()) {}

ProgressBar::~ProgressBar() {
  if (shown_ && drawn_ms_ > 0) std::fputs("\r\033[K", stderr);
}

void ProgressBar::update(std::size_t done, std::size_t total, const std::string& note) {
  const std::int64_t now = now_ms();
  if (!shown_ || total == 0 || now - started_ms_ < 300 || now - drawn_ms_ < 100) return;
  drawn_ms_ = now;
  const double share = static_cast<double>(done) / static_cast<double>(total);
  const double left =
      share > 0.0 ? static_cast<double>(now - started_ms_) / 1000.0 * (1.0 - share) / share : 0.0;
  const auto filled = static_cast<std::size_t>(share * 30.0);
  std::fputs(fmt::format("\r{} [{:<30}] {:3.0f} %  {}/{}  {:.0f} s left  {}\033[K", what_,
                         std::string(filled, '#'), share * 100.0, done, total, left, note)
                 .c_str(),
             stderr);
}

std::string percent(double share, int decimals) {
  return fmt::format("{:.{}f} %", share * 100.0, decimals);
}

std::string text_table(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], row[c].size());
  }
  std::string text;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t c = 0; c < row.size(); ++c) {
      line += c == 0 ? fmt::format("{:<{}}", row[c], widths[c])
                     : fmt::format("  {:>{}}", row[c], widths[c]);
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

}  // namespace linewright::cli
