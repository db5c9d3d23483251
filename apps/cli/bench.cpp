#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "common.hpp"
#include "linewright/allocation/allocator.hpp"
#include "linewright/base/diagnostic.hpp"
#include "linewright/base/random.hpp"
#include "linewright/evaluation/event_log_writer.hpp"
#include "linewright/planning/episode.hpp"

namespace linewright::cli {
namespace {

using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

struct BenchArguments {
  RunArguments run;
  double seconds = 2.0;
};

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

struct Speed {
  double decisions_per_second = 0.0;
  double episodes_per_second = 0.0;
  double copy_ns = 0.0;
  std::size_t state_bytes = 0;
  double speedup = 0.0;  ///< episodes per second of all cores over one
  std::size_t threads = 0;
};

std::size_t bytes_of(const SimulationState& state) {
  const auto bytes = [](const auto& list) { return list.capacity() * sizeof(list[0]); };
  return sizeof(state) + bytes(state.values) + bytes(state.dirty_operations) +
         bytes(state.dirty_tasks) + bytes(state.selectable) + bytes(state.workers) +
         bytes(state.carriers) + bytes(state.machines) + bytes(state.executions) +
         bytes(state.events) + bytes(state.waiting);
}

/// Whole episodes one after the other on this thread, with mask and allocation, without a log.
void measure_episodes(const Scenario& scenario, const Simulator& simulator,
                      const BenchArguments& arguments, Speed& speed) {
  const Configuration& configuration = arguments.run.configuration;
  const auto planner = PlannerRegistry::make(configuration.planner, simulator,
                                             planner_context(scenario, configuration.allocator));
  const auto allocator = make_allocator(configuration.allocator, simulator);
  const RunOptions crew = one_crew(arguments.run, simulator.line());
  std::vector<RunSetup> setups;
  for (std::uint64_t i = 0; i < 64; ++i) {
    setups.push_back(sample_setup(simulator.line(), crew,
                                  RandomStream::derive(arguments.run.seed, "setup", i).next()));
  }
  SimulationState state;
  std::int64_t decisions = 0;
  std::int64_t episodes = 0;
  const auto start = Clock::now();
  double elapsed = 0.0;
  while (elapsed < arguments.seconds && !interrupted().requested()) {
    for (const RunSetup& setup : setups) {
      run_episode(simulator, state, setup, static_cast<std::uint64_t>(episodes), *planner,
                  *allocator);
      decisions += state.decisions;
      ++episodes;
    }
    elapsed = seconds_since(start);
  }
  speed.decisions_per_second = static_cast<double>(decisions) / elapsed;
  speed.episodes_per_second = static_cast<double>(episodes) / elapsed;
}

void measure_copy(const Simulator& simulator, const BenchArguments& arguments, Speed& speed) {
  SimulationState state;
  const RunOptions crew = one_crew(arguments.run, simulator.line());
  simulator.reset(state, sample_setup(simulator.line(), crew, arguments.run.seed));
  simulator.advance(state);
  SimulationState copy = state;
  constexpr int kCopies = 200'000;
  const auto start = Clock::now();
  for (int i = 0; i < kCopies; ++i) {
    state.decisions = i;  // keeps the copies from being merged
    copy = state;
  }
  speed.copy_ns = seconds_since(start) * 1e9 / kCopies;
  speed.state_bytes = bytes_of(copy);
}

void measure_threads(const Scenario& scenario, const BenchArguments& arguments, Speed& speed) {
  TrialPlan plan{
      .crews = {one_crew(arguments.run, scenario.line)},
      .trials = std::max<std::size_t>(
          64, static_cast<std::size_t>(speed.episodes_per_second * arguments.seconds / 4)),
      .seed = arguments.run.seed,
      .threads = 1,
      .now_ns = clock_ns};
  const auto time = [&](std::size_t threads) {
    plan.threads = threads;
    const auto start = Clock::now();
    const auto results =
        run_trials(scenario, arguments.run.configuration, plan, {}, &interrupted());
    return seconds_since(start) / static_cast<double>(std::max<std::size_t>(1, results.size()));
  };
  speed.threads = std::max(1U, std::thread::hardware_concurrency());
  time(1);  // warm-up
  speed.speedup = time(1) / time(speed.threads);
}

/// FNV-1a over the events of a fixed set of runs: changes exactly when behaviour changes. The
/// logs' headers say how a run is drawn, too, and do not count.
std::string fingerprint(const Scenario& scenario, const Simulator& simulator,
                        const RunArguments& run) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  SimulationState state;
  EventLog log;
  for (const char* planner_name : {"first", "random"}) {
    // These for good: a new allocator must not change the fingerprint.
    for (const char* allocator_name : {"sap", "no_spatial", "longest_path", "first_idle"}) {
      const auto planner = PlannerRegistry::make(planner_name, simulator);
      const auto allocator = make_allocator(allocator_name, simulator);
      for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        RunOptions options{.workers = {}, .order = run.order, .horizon = run.horizon};
        run_episode(simulator, state, sample_setup(simulator.line(), options, seed), seed, *planner,
                    *allocator, {.log = &log});
        for (const char c : event_log_lines(scenario, log, 0, simulator.progress(state))) {
          hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
        }
      }
    }
  }
  return fmt::format("{:016x}", hash);
}

int bench(const BenchArguments& arguments) {
  const Scenario scenario = load(arguments.run.scenario);
  const Simulator simulator(std::make_shared<const LineModel>(scenario.line));
  Speed speed;
  measure_episodes(scenario, simulator, arguments, speed);
  measure_copy(simulator, arguments, speed);
  measure_threads(scenario, arguments, speed);
  if (interrupted().requested()) {
    report("interrupted: nothing measured");
    return kInterrupted;
  }
  const std::string print_of = fingerprint(scenario, simulator, arguments.run);
  if (arguments.run.json) {
    print(Json{{"decisions_per_second", speed.decisions_per_second},
               {"episodes_per_second", speed.episodes_per_second},
               {"fingerprint", print_of},
               {"state_copy_ns", speed.copy_ns},
               {"state_bytes", speed.state_bytes},
               {"threads", speed.threads},
               {"thread_speedup", speed.speedup}}
              .dump(2) +
          "\n");
    return kOk;
  }
  print(text_table({
      {"decisions per second, one core", fmt::format("{:.0f}", speed.decisions_per_second)},
      {"episodes per second, one core", fmt::format("{:.0f}", speed.episodes_per_second)},
      {"copy of a state", fmt::format("{:.0f} ns", speed.copy_ns)},
      {"memory of a state", fmt::format("{} bytes", speed.state_bytes)},
      {fmt::format("evaluate, {} threads over one", speed.threads),
       fmt::format("{:.2f} x", speed.speedup)},
      {"fingerprint", print_of},
  }));
  return kOk;
}

}  // namespace

Command add_bench(CLI::App& app) {
  auto arguments = std::make_shared<BenchArguments>();
  arguments->run.scenario = "scenarios/duct_line.yaml";
  app.add_option("scenario", arguments->run.scenario, "Scenario file")
      ->capture_default_str()
      ->type_name("SCENARIO");
  add_run_options(app, arguments->run);
  add_configuration_options(app, arguments->run);
  app.add_option("--seconds", arguments->seconds, "How long to measure")
      ->capture_default_str()
      ->check(CLI::Range(0.05, 3600.0))
      ->type_name("S");
  app.footer(
      "Speed is that of whole runs with action mask and allocation, without a log. The fingerprint "
      "is a hash\n"
      "of the event logs of 40 fixed runs: it changes exactly when behaviour changes.\n"
      "Example:\n  linewright bench scenarios/duct_line.yaml --humans 2 --robots 2");
  return [arguments] { return bench(*arguments); };
}

}  // namespace linewright::cli
