// The simulator's inner loop: whole episodes, single decisions, copies. Run with `make bench`.

#include <benchmark/benchmark.h>

#include <memory>

#include "linewright/allocation/allocator.hpp"
#include "linewright/planning/episode.hpp"
#include "linewright/planning/planner.hpp"
#include "linewright/planning/state_key.hpp"
#include "linewright/scenario/load.hpp"

namespace linewright {
namespace {

const Simulator& duct_line() {
  static const Simulator simulator(std::make_shared<const LineModel>(
      load_scenario(LINEWRIGHT_SOURCE_DIR "/scenarios/duct_line.yaml").line));
  return simulator;
}

RunSetup setup_of(std::int64_t humans, std::int64_t robots) {
  RunOptions crew;
  crew.workers = {static_cast<std::int32_t>(humans), static_cast<std::int32_t>(robots)};
  return sample_setup(duct_line().line(), crew, 1);
}

/// Episodes with mask and allocation, no log; counts decisions.
void episodes(benchmark::State& run, const char* planner_name, const char* allocator_name) {
  const auto planner = PlannerRegistry::make(planner_name, duct_line());
  const auto allocator = make_allocator(allocator_name, duct_line());
  const RunSetup setup = setup_of(run.range(0), run.range(1));
  SimulationState state;
  std::int64_t decisions = 0;
  for (auto _ : run) {
    run_episode(duct_line(), state, setup, 1, *planner, *allocator);
    decisions += state.decisions;
  }
  run.counters["decisions"] =
      benchmark::Counter(static_cast<double>(decisions), benchmark::Counter::kIsRate);
}
BENCHMARK_CAPTURE(episodes, first_sap, "first", "sap")->Args({1, 1})->Args({2, 2})->Args({3, 3});
BENCHMARK_CAPTURE(episodes, random_sap, "random", "sap")->Args({2, 2});
BENCHMARK_CAPTURE(episodes, first_no_spatial, "first", "no_spatial")->Args({3, 3});

void reset(benchmark::State& run) {
  const RunSetup setup = setup_of(2, 2);
  SimulationState state;
  for (auto _ : run) duct_line().reset(state, setup);
}
BENCHMARK(reset);

void copy_state(benchmark::State& run) {
  SimulationState state;
  duct_line().reset(state, setup_of(2, 2));
  duct_line().advance(state);
  SimulationState copy = state;
  for (auto _ : run) {
    copy = state;
    benchmark::DoNotOptimize(copy.values.data());
  }
}
BENCHMARK(copy_state);

void key_of_state(benchmark::State& run) {
  SimulationState state;
  duct_line().reset(state, setup_of(2, 2));
  duct_line().advance(state);
  std::vector<std::int32_t> scratch;
  for (auto _ : run) benchmark::DoNotOptimize(state_key(duct_line(), state, scratch));
}
BENCHMARK(key_of_state);

void load_the_scenario(benchmark::State& run) {
  for (auto _ : run) {
    benchmark::DoNotOptimize(load_scenario(LINEWRIGHT_SOURCE_DIR "/scenarios/duct_line.yaml"));
  }
}
BENCHMARK(load_the_scenario)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace linewright

BENCHMARK_MAIN();
