#include "linewright/planning/shield.hpp"

#include <gtest/gtest.h>

#include "linewright/allocation/advance.hpp"
#include "linewright/allocation/allocator.hpp"
#include "linewright/planning/dead_states.hpp"
#include "linewright/planning/episode.hpp"
#include "tests/support.hpp"

namespace linewright::testing {
namespace {

RunStatus play(const Simulator& simulator, const RunSetup& setup, std::uint64_t seed,
               const std::string& planner, const std::string& allocator, Shield* shield,
               EventLog* log = nullptr) {
  const auto plans = PlannerRegistry::make(planner, simulator);
  const auto allocates = make_allocator(allocator, simulator);
  SimulationState state;
  return run_episode(simulator, state, setup, seed, *plans, *allocates,
                     {.log = log, .shield = shield});
}

TEST(Shield, LetsEvenRandomRunsOfOneRobotFinish) {
  const Simulator& simulator = *shipped_line("scenarios/duct_line.yaml").simulator;
  Shield shield(simulator);
  std::size_t stuck_without = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const RunSetup setup = sample_setup(simulator.line(), crew_of({1, 1}), seed);
    EXPECT_EQ(play(simulator, setup, seed, "random", "sap", &shield), RunStatus::kFinished) << seed;
    EXPECT_EQ(shield.statistics().unknown, 0U) << seed;
    if (play(simulator, setup, seed, "random", "sap", nullptr) != RunStatus::kFinished)
      ++stuck_without;
  }
  EXPECT_GT(stuck_without, 25U);
}

TEST(Shield, LetsRandomRunsOfEveryCrewAndAllocatorFinish) {
  const Simulator& simulator = *shipped_line("scenarios/duct_line.yaml").simulator;
  Shield shield(simulator);
  for (int humans = 1; humans <= 3; ++humans) {
    for (int robots = 1; robots <= 3; ++robots) {
      for (const std::string& allocator : allocator_names()) {
        const RunSetup setup = sample_setup(simulator.line(), crew_of({humans, robots}), 7);
        EXPECT_EQ(play(simulator, setup, 7, "random", allocator, &shield), RunStatus::kFinished)
            << humans << robots << allocator;
      }
    }
  }
}

TEST(Shield, ChangesNoRunThatFinishesWithoutIt) {
  for (const char* file : {"scenarios/teaching/one_human_one_robot.yaml",
                           "scenarios/teaching/kitting_cell.yaml", "scenarios/duct_line.yaml"}) {
    const Simulator& simulator = *shipped_line(file).simulator;
    Shield shield(simulator);
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      const RunSetup setup = sample_setup(simulator.line(), {}, seed);
      EventLog without;
      EventLog with;
      if (play(simulator, setup, seed, "first", "sap", nullptr, &without) != RunStatus::kFinished)
        continue;
      EXPECT_EQ(play(simulator, setup, seed, "first", "sap", &shield, &with), RunStatus::kFinished);
      EXPECT_EQ(shield.statistics().fatal, 0U);
      EXPECT_EQ(with.events.size(), without.events.size()) << file << seed;
    }
  }
}

TEST(Shield, AgreesWithTheExhaustiveSearch) {
  const Simulator& simulator = *shipped_line("scenarios/duct_line.yaml").simulator;
  const auto allocator = make_allocator("sap", simulator);
  const auto planner = PlannerRegistry::make("random", simulator);
  Shield shield(simulator);
  std::size_t fatal = 0;
  for (std::uint64_t seed = 1; seed <= 15; ++seed) {
    planner->reset(seed);
    shield.reset();
    SimulationState state;
    simulator.reset(state, sample_setup(simulator.line(), crew_of({1, 1}, 2), seed));
    while (advance_and_join(simulator, state, *allocator) == RunStatus::kDecision) {
      const auto decision = planner->decide(state, all_choices(simulator, state));
      simulator.assign(state, allocator->allocate(state, *decision.task));
      const Shield::Verdict verdict = shield.judge(state);
      const Liveness::Verdict searched = can_finish(simulator, state, {.rollouts = 20}).verdict;
      if (verdict == Shield::Verdict::kFatal) {
        EXPECT_NE(searched, Liveness::Verdict::kAlive) << seed << " at " << state.now;
        ++fatal;
        break;
      }
      EXPECT_EQ(verdict, Shield::Verdict::kSafe);
      EXPECT_NE(searched, Liveness::Verdict::kDead) << seed << " at " << state.now;
    }
  }
  EXPECT_GT(fatal, 5U);
}

TEST(Shield, SaysTheSameEveryTime) {
  const Simulator& simulator = *shipped_line("scenarios/duct_line.yaml").simulator;
  Shield shield(simulator);
  const RunSetup setup = sample_setup(simulator.line(), crew_of({1, 1}), 3);
  EventLog once;
  EventLog again;
  play(simulator, setup, 3, "random", "no_spatial", &shield, &once);
  play(simulator, sample_setup(simulator.line(), crew_of({2, 2}), 4), 4, "random", "sap", &shield);
  play(simulator, setup, 3, "random", "no_spatial", &shield, &again);
  ASSERT_EQ(once.events.size(), again.events.size());
  for (std::size_t i = 0; i < once.events.size(); ++i)
    EXPECT_EQ(once.events[i].tick, again.events[i].tick);
}

TEST(Shield, DoesNotStopARunOfWhichItIsNotSure) {
  // With nothing to look with, every state is unknown: the run is as it is without a shield.
  const Simulator& simulator = *shipped_line("scenarios/teaching/kitting_cell.yaml").simulator;
  Shield blind(simulator, {.rollouts = 0, .max_states = 0});
  const RunSetup setup = sample_setup(simulator.line(), {}, 2);
  EXPECT_EQ(play(simulator, setup, 2, "first", "sap", &blind), RunStatus::kFinished);
  EXPECT_GT(blind.statistics().unknown, 0U);
}

}  // namespace
}  // namespace linewright::testing
