#include "linewright/environment/observation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "linewright/base/random.hpp"
#include "linewright/environment/environment.hpp"
#include "small_line.hpp"

namespace linewright {
namespace {

struct Seen {
  explicit Seen(const ObservationSpec& spec)
      : features(spec.feature_count(), std::numeric_limits<float>::quiet_NaN()),
        present(spec.token_count(), 7),
        selectable(spec.actions.size(), 7) {}
  ObservationView view() { return {features.data(), present.data(), selectable.data()}; }

  std::vector<float> features;
  std::vector<std::uint8_t> present;
  std::vector<std::uint8_t> selectable;
  friend bool operator==(const Seen&, const Seen&) = default;
};

/// Index of the feature of a token of a group.
std::size_t index_of(const ObservationSpec& spec, const std::string& group_name, std::size_t token,
                     const std::string& feature) {
  std::size_t index = 0;
  for (const TokenGroup& group : spec.groups) {
    for (std::size_t t = 0; t < group.tokens.size(); ++t) {
      for (const std::string& name : group.features_of(t)) {
        if (group.name == group_name && t == token && name == feature) return index;
        ++index;
      }
    }
  }
  ADD_FAILURE() << "no feature " << group_name << "." << feature;
  return 0;
}

TEST(Observation, WritesEveryNumberAndStaysBounded) {
  const Simulator simulator = small_line();
  const ObservationEncoder encoder(simulator);
  Environment environment(simulator, "sap", {});
  RandomStream random(1);
  for (std::uint64_t episode = 0; episode < 20; ++episode) {
    ASSERT_TRUE(environment.reset(sample_setup(simulator.line(), {}, episode), episode));
    while (!environment.state().ended()) {
      Seen seen(encoder.spec());
      encoder.encode(environment.state(), seen.view());
      for (const float value : seen.features) {
        ASSERT_TRUE(std::isfinite(value));
        ASSERT_LE(std::abs(value), 4.0F);
      }
      for (const std::uint8_t flag : seen.present) ASSERT_LE(flag, 1);
      for (std::size_t t = 0; t < simulator.line().tasks.size(); ++t) {
        ASSERT_EQ(seen.selectable[t] == 1, environment.state().is_selectable(TaskId(t)));
      }
      std::size_t action = random.below(seen.selectable.size());
      while (seen.selectable[action] == 0) action = random.below(seen.selectable.size());
      environment.step(action);
    }
  }
}

TEST(Observation, ShowsWhoIsThereAndHidesWhoIsNot) {
  const Simulator simulator = small_line();
  const ObservationEncoder encoder(simulator);
  SimulationState state;
  simulator.reset(state, sample_setup(simulator.line(), {.workers = {1, 2}}, 1));
  simulator.advance(state);
  Seen seen(encoder.spec());
  encoder.encode(state, seen.view());
  // Two people and two robots are possible, and as many trolleys as robots.
  EXPECT_EQ((std::vector<std::uint8_t>(seen.present.begin(), seen.present.begin() + 6)),
            (std::vector<std::uint8_t>{1, 0, 1, 1, 1, 1}));
  EXPECT_TRUE(std::all_of(seen.present.begin() + 6, seen.present.end(),
                          [](std::uint8_t flag) { return flag == 1; }));
  const std::size_t width = encoder.spec().groups[0].features[0].size();
  EXPECT_TRUE(std::all_of(seen.features.begin() + static_cast<std::ptrdiff_t>(width),
                          seen.features.begin() + static_cast<std::ptrdiff_t>(2 * width),
                          [](float value) { return value == 0.0F; }));
}

TEST(Observation, SaysWhereWorkersAreOnTheirWay) {
  const Simulator simulator = small_line();
  const ObservationEncoder encoder(simulator);
  SimulationState state;
  simulator.reset(state, sample_setup(simulator.line(), {.workers = {1, 1}}, 1));
  simulator.advance(state);
  const auto allocator = make_allocator("sap", simulator);
  simulator.assign(state, allocator->allocate(state, TaskId(std::size_t{0})));
  Seen seen(encoder.spec());
  std::vector<float> places;
  for (Tick tick = state.now; tick < state.now + 4; ++tick) {
    SimulationState later = state;
    simulator.advance_to(later, tick);
    encoder.encode(later, seen.view());
    places.push_back(seen.features[index_of(encoder.spec(), "human", 0, "x")]);
  }
  EXPECT_GT(places[0], places[1]);  // from the press at x = 6 to the rack at x = 0
  EXPECT_GT(places[1], places[2]);
  EXPECT_NEAR(places[1] - places[2], places[2] - places[3], 1e-5);
}

TEST(Observation, OfTheStartIsTheSameForAllLargeOrders) {
  const Simulator simulator = small_line();
  const ObservationEncoder encoder(simulator);
  const auto start = [&](std::int32_t order) {
    SimulationState state;
    simulator.reset(state, sample_setup(simulator.line(), {.workers = {1, 1}, .order = order}, 1));
    simulator.advance(state);
    Seen seen(encoder.spec());
    encoder.encode(state, seen.view());
    return seen;
  };
  EXPECT_EQ(start(5), start(9));
  EXPECT_NE(start(2), start(9));
}

TEST(Observation, HasTheTasksAndTheGlobalTokenLast) {
  const Simulator simulator = small_line();
  const ObservationEncoder encoder(simulator);
  const ObservationSpec& spec = encoder.spec();
  ASSERT_GE(spec.groups.size(), 2U);
  EXPECT_EQ(spec.groups[spec.groups.size() - 2].name, "tasks");
  EXPECT_EQ(spec.groups.back().name, "global");
  EXPECT_EQ(spec.groups[spec.groups.size() - 2].tokens, spec.actions);
}

}  // namespace
}  // namespace linewright
