#include "linewright/planning/dead_states.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "linewright/allocation/allocator.hpp"
#include "linewright/planning/episode.hpp"
#include "linewright/planning/state_key.hpp"
#include "tests/support.hpp"

namespace linewright::testing {
namespace {

TEST(DeadStates, OfTheDuctLineComeFromCollectingEarly) {
  const Simulator& simulator = *shipped_line("scenarios/duct_line.yaml").simulator;
  const DeadStateReport report = find_dead_states(simulator, crew_of({1, 1}), {.runs = 60});
  EXPECT_GT(report.stuck, 40U);  // 66 of 72 in the published runs
  const auto early =
      std::find_if(report.found.begin(), report.found.end(), [&](const DeadState& dead) {
        return simulator.line().tasks[dead.decisions.back().task.index()].name == "collect_ducts";
      });
  ASSERT_NE(early, report.found.end());
  EXPECT_TRUE(early->proven);
  EXPECT_EQ(early->decisions.size(), 1U);
}

TEST(DeadStates, AreDeadForEveryContinuationAndAliveBefore) {
  const Simulator& simulator = *shipped_line("scenarios/duct_line.yaml").simulator;
  const auto allocator = make_allocator("sap", simulator);
  SimulationState state;
  simulator.reset(state, sample_setup(simulator.line(), crew_of({1, 1}), 5));
  ASSERT_EQ(simulator.advance(state), RunStatus::kDecision);
  EXPECT_EQ(can_finish(simulator, state, {}).verdict, Liveness::Verdict::kAlive);
  for (std::size_t t = 0; t < simulator.line().tasks.size(); ++t) {
    if (simulator.line().tasks[t].name != "collect_ducts") continue;
    ASSERT_TRUE(simulator.assign(state, allocator->allocate(state, TaskId(t))));
  }
  EXPECT_EQ(can_finish(simulator, state, {}).verdict, Liveness::Verdict::kDead);
}

TEST(DeadStates, DoNotExistWhereEveryRunFinishes) {
  for (const char* file :
       {"scenarios/teaching/one_human_one_robot.yaml", "scenarios/teaching/kitting_cell.yaml"}) {
    const DeadStateReport report =
        find_dead_states(*shipped_line(file).simulator, {}, {.runs = 30});
    EXPECT_EQ(report.stuck, 0U) << file;
    EXPECT_TRUE(report.found.empty()) << file;
  }
}

TEST(StateKey, IsTheSameForStatesWithTheSameFutureAtDifferentTimes) {
  const Simulator& simulator = *shipped_line("scenarios/duct_line.yaml").simulator;
  SimulationState state;
  simulator.reset(state, sample_setup(simulator.line(), crew_of({1, 1}), 5));
  std::vector<std::int32_t> scratch;
  // Without decisions the line comes to rest once the first straight has reached the cutter.
  simulator.advance_to(state, 200);
  const StateKey early = state_key(simulator, state, scratch);
  simulator.advance_to(state, 300);
  EXPECT_EQ(state_key(simulator, state, scratch), early);
  const auto allocator = make_allocator("sap", simulator);
  simulator.assign(state, allocator->allocate(state, TaskId(0)));
  EXPECT_FALSE(state_key(simulator, state, scratch) == early);
}

}  // namespace
}  // namespace linewright::testing
