#include "linewright/environment/environment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "linewright/base/diagnostic.hpp"
#include "linewright/environment/vector_environment.hpp"
#include "small_line.hpp"

namespace linewright {
namespace {

std::size_t first_selectable(const SimulationState& state, std::size_t tasks) {
  for (std::size_t t = 0; t < tasks; ++t) {
    if (state.is_selectable(TaskId(t))) return t;
  }
  return tasks;
}

TEST(Environment, PaysTimeProgressAndTheGoal) {
  const Simulator simulator = small_line();
  Environment environment(simulator, "sap", {.eta1 = 0.01, .eta2 = 5.0, .eta3 = 2.0});
  ASSERT_TRUE(environment.reset(sample_setup(simulator.line(), {.workers = {1, 1}}, 1), 1));
  const Tick first = environment.state().now;
  double total = 0.0;
  StepResult last;
  while (!environment.state().ended()) {
    const Tick before = environment.state().now;
    const double progress = simulator.progress(environment.state());
    last = environment.step(first_selectable(environment.state(), 2));
    double expected = -0.01 * (environment.state().now - before) +
                      2.0 * (simulator.progress(environment.state()) - progress);
    if (last.ended) expected += 5.0;
    EXPECT_NEAR(double(last.reward), expected, 1e-6);
    total += double(last.reward);
  }
  EXPECT_TRUE(last.success);
  EXPECT_EQ(environment.makespan(), environment.state().now);
  EXPECT_NEAR(total, -0.01 * (environment.makespan() - first) + 2.0 + 5.0, 1e-5);
}

TEST(Environment, PaysForDecisionsWhereItIsAsked) {
  const Simulator simulator = small_line();
  const RunSetup setup = sample_setup(simulator.line(), {.workers = {1, 1}}, 1);
  Environment plain(simulator, "sap", {});
  Environment paying(simulator, "sap", {.decision_bonus = 0.1});
  ASSERT_TRUE(plain.reset(setup, 1));
  ASSERT_TRUE(paying.reset(setup, 1));
  while (!plain.state().ended()) {
    const std::size_t task = first_selectable(plain.state(), 2);
    EXPECT_NEAR(double(paying.step(task).reward), double(plain.step(task).reward) + 0.1, 1e-6);
  }
}

TEST(Environment, ChargesAFailureUpToTheHorizon) {
  const Simulator simulator = small_line();
  Environment environment(simulator, "sap", {.eta1 = 0.01, .eta2 = 5.0, .eta3 = 0.0});
  ASSERT_TRUE(
      environment.reset(sample_setup(simulator.line(), {.workers = {1, 1}, .horizon = 40}, 1), 1));
  const Tick first = environment.state().now;
  double total = 0.0;
  StepResult last;
  while (!environment.state().ended()) {
    last = environment.step(first_selectable(environment.state(), 2));
    total += double(last.reward);
  }
  EXPECT_FALSE(last.success);
  EXPECT_EQ(environment.makespan(), 40);
  EXPECT_NEAR(total, -0.01 * (40 - first) - 5.0, 1e-5);
}

TEST(Environment, RefusesAnActionThatIsNotSelectable) {
  const Simulator simulator = small_line();
  Environment environment(simulator, "sap", {});
  ASSERT_TRUE(environment.reset(sample_setup(simulator.line(), {}, 1), 1));
  EXPECT_THROW(environment.step(1), std::logic_error);  // there is no blank to press yet
  EXPECT_THROW(Environment(simulator, "nobody", {}), ScenarioError);
}

/// Rewards and the result of an episode by the first selectable task.
struct Played {
  double reward = 0.0;
  Tick makespan = 0;
  Tick ended = 0;  ///< on the clock of the run, pauses included
  bool success = false;
};

Played play(Environment& environment, const RunSetup& setup, std::uint64_t seed) {
  Played played;
  EXPECT_TRUE(environment.reset(setup, seed));
  while (!environment.state().ended()) {
    const StepResult result = environment.step(first_selectable(environment.state(), 2));
    played.reward += double(result.reward);
    played.success = result.success;
  }
  played.makespan = environment.makespan();
  played.ended = environment.state().now;
  return played;
}

TEST(Environment, DoesNotCountPauses) {
  const Simulator simulator = small_line();
  const RunSetup setup = sample_setup(simulator.line(), {.workers = {1, 1}}, 1);
  const RewardOptions rewards{.eta1 = 0.01, .eta2 = 5.0, .eta3 = 2.0};
  Environment steady(simulator, "sap", rewards);
  Environment pausing(simulator, "sap", rewards, {.episodes = 1.0, .decisions = 0.5, .most = 50});
  const Played without = play(steady, setup, 1);
  Tick longest = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Played with = play(pausing, setup, seed);
    EXPECT_TRUE(with.success);
    EXPECT_EQ(pausing.horizon(), setup.horizon);
    // One person does one thing after the other: a pause can only wait, never help.
    EXPECT_LE(with.makespan, without.makespan);
    EXPECT_GE(with.ended, with.makespan);
    // Reward and makespan agree on what was counted.
    EXPECT_NEAR(with.reward - without.reward, 0.01 * (without.makespan - with.makespan), 1e-4);
    longest = std::max(longest, with.ended - with.makespan);
  }
  EXPECT_GT(longest, 50);
  EXPECT_EQ(play(pausing, setup, 3).ended, play(pausing, setup, 3).ended);
}

TEST(Environment, FailsBehindTheHorizonWithPausesLeftOut) {
  const Simulator simulator = small_line();
  const RunSetup setup = sample_setup(simulator.line(), {.workers = {1, 1}, .horizon = 40}, 1);
  Environment pausing(simulator, "sap", {.eta1 = 0.01, .eta2 = 5.0, .eta3 = 0.0},
                      {.episodes = 1.0, .decisions = 0.5, .most = 50});
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Played played = play(pausing, setup, seed);
    EXPECT_FALSE(played.success);
    EXPECT_EQ(played.makespan, 40);
    EXPECT_NEAR(played.reward, -0.01 * 40 - 5.0, 0.02);  // the first decision is due at once
  }
}

/// Memory for the observations of some runs.
struct Rows {
  Rows(const ObservationSpec& spec, std::size_t runs)
      : actions(spec.actions.size()),
        features(runs * spec.feature_count()),
        present(runs * spec.token_count()),
        selectable(runs * actions) {}
  ObservationRows rows() { return {features.data(), present.data(), selectable.data()}; }

  std::size_t actions;
  std::vector<float> features;
  std::vector<std::uint8_t> present;
  std::vector<std::uint8_t> selectable;
};

EpisodePlan four_crews(EpisodePlan::Order order) {
  EpisodePlan plan{.order = order, .seed = 5};
  for (const std::int32_t humans : {1, 2}) {
    for (const std::int32_t robots : {1, 2}) plan.crews.push_back({.workers = {humans, robots}});
  }
  return plan;
}

std::size_t any_action(ObservationView view, std::size_t actions, std::size_t wish) {
  std::size_t action = wish % actions;
  while (view.selectable[action] == 0) action = (action + 1) % actions;
  return action;
}

/// Everything that some hundred steps show, with so many threads.
std::vector<float> history(std::size_t threads) {
  const Simulator simulator = small_line();
  WorkerPool pool(threads);
  VectorEnvironment environments(simulator, four_crews(EpisodePlan::Order::kSampled), "no_spatial",
                                 {}, 7, pool);
  Rows rows(environments.spec(), 7);
  environments.reset(rows.rows());
  std::vector<float> all;
  for (std::size_t step = 0; step < 200; ++step) {
    environments.step(
        [&](std::size_t run, std::size_t, ObservationView view) {
          return any_action(view, rows.actions, step + run);
        },
        rows.rows());
    all.insert(all.end(), rows.features.begin(), rows.features.end());
    for (const auto& s : environments.steps()) {
      all.push_back(s.result.reward);
      all.push_back(static_cast<float>(s.episode));
    }
  }
  return all;
}

TEST(VectorEnvironment, DoesNotDependOnTheNumberOfThreads) { EXPECT_EQ(history(1), history(3)); }

TEST(VectorEnvironment, PlaysEveryEpisodeOfThePlanOnce) {
  const Simulator simulator = small_line();
  WorkerPool pool(2);
  VectorEnvironment environments(simulator, four_crews(EpisodePlan::Order::kInTurn), "sap", {}, 3,
                                 pool);
  Rows rows(environments.spec(), 3);
  environments.reset(rows.rows());
  std::vector<std::uint64_t> ended;
  for (int step = 0; step < 300; ++step) {
    std::vector<std::uint16_t> actions;
    for (std::size_t run = 0; run < 3; ++run) {
      const std::uint8_t* selectable = rows.selectable.data() + run * rows.actions;
      actions.push_back(selectable[0] != 0 ? 0 : 1);
    }
    environments.step(actions, rows.rows());
    for (const auto& s : environments.steps()) {
      if (!s.result.ended) continue;
      ended.push_back(s.episode);
      EXPECT_TRUE(s.result.success);
      EXPECT_GT(s.makespan, 0);
      EXPECT_EQ(s.progress, 1.0);
    }
  }
  std::sort(ended.begin(), ended.end());
  EXPECT_EQ(std::unique(ended.begin(), ended.end()), ended.end());
  EXPECT_GT(ended.size(), 50U);
}

TEST(VectorEnvironment, GoesOnFromTheDecisionsOfAnEpisode) {
  const Simulator simulator = small_line();
  WorkerPool pool(1);
  const EpisodePlan plan = four_crews(EpisodePlan::Order::kSampled);
  VectorEnvironment environments(simulator, plan, "sap", {}, 2, pool);
  Rows rows(environments.spec(), 2);
  environments.reset(rows.rows());
  std::vector<std::uint16_t> taken;
  for (std::size_t step = 0; step < 3; ++step) {
    environments.step(
        [&](std::size_t run, std::size_t, ObservationView view) {
          const std::size_t action = any_action(view, rows.actions, step);
          if (run == 1) taken.push_back(static_cast<std::uint16_t>(action));
          return action;
        },
        rows.rows());
  }
  VectorEnvironment other(simulator, plan, "sap", {}, 2, pool);
  Rows again(other.spec(), 2);
  other.reset(again.rows());
  other.restore(1, environments.episode(1), taken, again.rows());
  const auto second = static_cast<std::ptrdiff_t>(other.spec().feature_count());
  EXPECT_TRUE(std::equal(rows.features.begin() + second, rows.features.end(),
                         again.features.begin() + second));
}

TEST(VectorEnvironment, RefusesCrewsThatTheLineCannotHave) {
  const Simulator simulator = small_line();
  WorkerPool pool(1);
  EpisodePlan plan{.crews = {{.workers = {9, 1}}}};
  EXPECT_THROW(VectorEnvironment(simulator, plan, "sap", {}, 2, pool), ScenarioError);
  plan.crews.clear();
  EXPECT_THROW(VectorEnvironment(simulator, plan, "sap", {}, 2, pool), ScenarioError);
}

TEST(Crews, AreEquallyOftenInTurn) {
  const EpisodePlan plan = four_crews(EpisodePlan::Order::kInTurn);
  std::vector<int> count(4);
  for (std::uint64_t i = 0; i < 400; ++i) ++count[episode_of(plan, i).crew];
  EXPECT_EQ(count, (std::vector<int>{100, 100, 100, 100}));
}

}  // namespace
}  // namespace linewright
