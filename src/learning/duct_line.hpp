#pragma once

#include <string>
#include <vector>

#include "linewright/base/random.hpp"
#include "linewright/environment/environment.hpp"
#include "linewright/scenario/load.hpp"

namespace linewright::learning {

/// Observations that random decisions meet on a shipped scenario; for tests and benchmarks.
struct SeenStates {
  ObservationSpec spec;
  std::size_t count = 0;
  std::vector<float> features;
  std::vector<std::uint8_t> present;
  std::vector<std::uint8_t> selectable;
};

inline SeenStates random_states(const std::string& scenario_file, std::size_t count,
                                std::uint64_t seed) {
  const Simulator simulator(std::make_shared<const LineModel>(load_scenario(scenario_file).line));
  const ObservationEncoder encoder(simulator);
  Environment environment(simulator, "sap", {});
  RandomStream random(seed);
  SeenStates seen{.spec = encoder.spec(), .count = count};
  const std::size_t actions = seen.spec.actions.size();
  seen.features.resize(count * encoder.feature_count());
  seen.present.resize(count * encoder.token_count());
  seen.selectable.resize(count * actions);
  for (std::size_t i = 0; i < count; ++i) {
    while (i == 0 || environment.state().ended()) {
      if (environment.reset(sample_setup(simulator.line(), {}, random.next()), i)) break;
    }
    std::uint8_t* selectable = seen.selectable.data() + i * actions;
    encoder.encode(environment.state(),
                   {seen.features.data() + i * encoder.feature_count(),
                    seen.present.data() + i * encoder.token_count(), selectable});
    std::size_t action = random.below(actions);
    while (selectable[action] == 0) action = random.below(actions);
    environment.step(action);
  }
  return seen;
}

}  // namespace linewright::learning
