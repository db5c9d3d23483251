// One allocation decision with 10 to 10,000 workers of each kind and as many carriers, beside the
// plain search over all of them. Run with `make bench`. Iterations are decisions; p50 and p99 are
// theirs in microseconds, `plain_p50` and `plain_p99` those of the plain search (up to 1,000 where
// a carrier is chosen too: it looks at every pair), `ratio` is plain_p50 / p50.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <memory>

#include "../tests/plain_allocator.hpp"
#include "linewright/scenario/load.hpp"

namespace linewright {
namespace {

using Clock = std::chrono::steady_clock;

/// `stations` stations on a square lattice; one task for a worker alone, one for worker and
/// carrier.
std::string line_with(std::int64_t stations) {
  std::string text =
      "schema: line/1\nname: lattice\nhorizon: 1000\n"
      "order: {product: p, quantity: 1, finished_in: done}\n"
      "workers: {robot: {count: 1, start: [s0]}}\n"
      "carriers: {cage: {count: 1, moved_by: robot, start: [s0]}}\n"
      "places: {stock: {of: p, initial: order}, done: {of: p}}\n"
      "tasks:\n"
      "  alone: {crew: {robot: 1}, when: [stock > 0], steps: [{robot: [{go: s0}, {transfer: "
      "[stock, "
      "done]}]}]}\n"
      "  pair: {crew: {robot: 1, cage: empty}, when: [stock > 0], steps: [{robot: [{fetch: cage}, "
      "{go: s0}, {transfer: [stock, cage]}]}]}\n"
      "travel: {robot: straight}\nstations:\n";
  for (std::int64_t s = 0; s < stations; ++s) {
    text += "  s" + std::to_string(s) + ": {robot: [" + std::to_string(s % 20 * 3) + ", " +
            std::to_string(s / 20 * 3) + ", 0]}\n";
  }
  return text;
}

/// `count` free workers and carriers on random stations; one worker in `moving` (0: none) is under
/// way.
SimulationState scattered(const Simulator& simulator, std::int64_t count, std::size_t moving) {
  SimulationState state;
  simulator.reset(state, sample_setup(simulator.line(), {}, 1));
  RandomStream random(1);
  const auto station = [&] {
    return static_cast<std::int16_t>(random.below(simulator.line().stations.size()));
  };
  state.now = 100;
  state.workers.assign(static_cast<std::size_t>(count), WorkerState{});
  state.carriers.assign(static_cast<std::size_t>(count), CarrierState{});
  for (WorkerState& worker : state.workers) {
    worker.station = worker.from = station();
    if (moving == 0 || random.below(moving) != 0) continue;
    worker.from = station();
    worker.depart = 95;
    worker.arrive = random.between(101, 120);
  }
  for (CarrierState& carrier : state.carriers) carrier.station = station();
  return state;
}

struct Times {
  double p50_us = 0.0;
  double p99_us = 0.0;
};

Times quantiles(std::vector<double>& us) {
  if (us.empty()) return {};
  std::sort(us.begin(), us.end());
  return {us[us.size() / 2], us[us.size() * 99 / 100]};
}

double decide_us(Allocator& allocator, const SimulationState& state, TaskId task) {
  const auto start = Clock::now();
  benchmark::DoNotOptimize(allocator.allocate(state, task));
  return std::chrono::duration<double, std::micro>(Clock::now() - start).count();
}

Times plain_times(const Simulator& simulator, const char* name, const SimulationState& state,
                  TaskId task) {
  testing::PlainAllocator plain(name, simulator);
  std::vector<double> us;
  double sum_us = 0.0;
  while (us.size() < 3 || (sum_us < 2e5 && us.size() < 2000)) {
    us.push_back(decide_us(plain, state, task));
    sum_us += us.back();
  }
  return quantiles(us);
}

/// Arguments: workers, stations, one worker in how many is under way.
void decide(benchmark::State& run, const char* name, const char* task_name) {
  const Simulator simulator(std::make_shared<const LineModel>(
      load_scenario_text(line_with(run.range(1)), "lattice.yaml").line));
  const SimulationState state =
      scattered(simulator, run.range(0), static_cast<std::size_t>(run.range(2)));
  const auto& tasks = simulator.line().tasks;
  const auto found = std::find_if(tasks.begin(), tasks.end(),
                                  [&](const Task& task) { return task.name == task_name; });
  const TaskId task(static_cast<std::size_t>(found - tasks.begin()));
  const auto allocator = make_allocator(name, simulator);
  allocator->reset(1);
  std::vector<double> us;
  for (auto _ : run) us.push_back(decide_us(*allocator, state, task));
  const Times times = quantiles(us);
  run.counters["p50"] = times.p50_us;
  run.counters["p99"] = times.p99_us;
  if (task.index() != 0 && run.range(0) > 1000) return;
  const Times plain = plain_times(simulator, name, state, task);
  run.counters["plain_p50"] = plain.p50_us;
  run.counters["plain_p99"] = plain.p99_us;
  run.counters["ratio"] = plain.p50_us / times.p50_us;
}

void sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgNames({"workers", "stations", "moving_one_in"})->Unit(benchmark::kMicrosecond);
  for (const std::int64_t workers : {10, 100, 1'000, 10'000}) {
    for (const std::int64_t stations : {15, 400}) benchmark->Args({workers, stations, 0});
  }
  benchmark->Args({1'000, 400, 20})->Args({10'000, 400, 20});
}
BENCHMARK_CAPTURE(decide, sap_alone, "sap", "alone")->Apply(sizes);
BENCHMARK_CAPTURE(decide, sap_pair, "sap", "pair")->Apply(sizes);
BENCHMARK_CAPTURE(decide, sap_snapped_pair, "sap_snapped", "pair")->Args({10'000, 400, 20});
BENCHMARK_CAPTURE(decide, longest_path_pair, "longest_path", "pair")->Args({10'000, 400, 0});
BENCHMARK_CAPTURE(decide, first_idle_pair, "first_idle", "pair")->Args({10'000, 400, 0});
BENCHMARK_CAPTURE(decide, no_spatial_alone, "no_spatial", "alone")
    ->Args({1'000, 400, 0})
    ->Args({10'000, 400, 0});
BENCHMARK_CAPTURE(decide, no_spatial_pair, "no_spatial", "pair")
    ->Args({1'000, 400, 0})
    ->Args({10'000, 400, 0});

}  // namespace
}  // namespace linewright

BENCHMARK_MAIN();
