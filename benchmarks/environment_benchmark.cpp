// The environment with a random policy: decisions per second including the observation.

#include <benchmark/benchmark.h>

#include <memory>

#include "linewright/base/random.hpp"
#include "linewright/environment/vector_environment.hpp"
#include "linewright/scenario/load.hpp"

namespace linewright {
namespace {

EpisodePlan nine_crews() {
  EpisodePlan plan;
  for (std::int32_t humans = 1; humans <= 3; ++humans) {
    for (std::int32_t robots = 1; robots <= 3; ++robots) {
      plan.crews.push_back({.workers = {humans, robots}, .order = 5});
    }
  }
  return plan;
}

std::size_t random_action(ObservationView view, std::size_t actions, RandomStream& random) {
  std::size_t count = 0;
  for (std::size_t a = 0; a < actions; ++a) count += view.selectable[a];
  std::size_t skip = random.below(count);
  std::size_t action = 0;
  while (view.selectable[action] == 0 || skip-- > 0) ++action;
  return action;
}

void random_policy(benchmark::State& run, const char* file) {
  const Simulator simulator(std::make_shared<const LineModel>(
      load_scenario(std::string(LINEWRIGHT_SOURCE_DIR "/scenarios/") + file).line));
  WorkerPool pool(static_cast<std::size_t>(run.range(0)));
  VectorEnvironment environments(simulator, nine_crews(), "sap", {}, 32, pool);
  const ObservationSpec& spec = environments.spec();
  std::vector<float> features(32 * spec.feature_count());
  std::vector<std::uint8_t> present(32 * spec.token_count());
  std::vector<std::uint8_t> selectable(32 * spec.actions.size());
  const ObservationRows rows{features.data(), present.data(), selectable.data()};
  std::vector<RandomStream> random;
  for (std::uint64_t i = 0; i < 32; ++i) random.push_back(RandomStream::derive(1, "policy", i));
  const std::size_t actions = spec.actions.size();
  environments.reset(rows);
  for (auto _ : run) {
    environments.step([&](std::size_t i, std::size_t,
                          ObservationView view) { return random_action(view, actions, random[i]); },
                      rows);
  }
  run.counters["features"] = static_cast<double>(spec.feature_count());
  run.counters["tokens"] = static_cast<double>(spec.token_count());
  run.counters["decisions"] =
      benchmark::Counter(static_cast<double>(run.iterations() * 32), benchmark::Counter::kIsRate);
}
BENCHMARK_CAPTURE(random_policy, duct_line, "duct_line.yaml")->Arg(1)->Arg(2)->UseRealTime();
BENCHMARK_CAPTURE(random_policy, duct_line_routed, "duct_line_routed.yaml")->Arg(1)->UseRealTime();

}  // namespace
}  // namespace linewright
