// Whom the allocators choose, against a plain enumeration of everyone who is free.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "linewright/allocation/allocator.hpp"
#include "linewright/planning/episode.hpp"
#include "linewright/planning/planner.hpp"
#include "tests/support.hpp"

namespace linewright::testing {
namespace {

/// Calls `check(state, task)` at every decision of some random runs with three humans and three
/// robots.
template <class Check>
void at_decisions(const Simulator& simulator, Check&& check) {
  const auto planner = PlannerRegistry::make("random", simulator);
  const auto allocator = make_allocator("no_spatial", simulator);
  SimulationState state;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    simulator.reset(state, sample_setup(simulator.line(), crew_of({3, 3}), seed));
    planner->reset(seed);
    allocator->reset(seed);
    while (advance_and_join(simulator, state, *allocator) == RunStatus::kDecision) {
      const TaskId task = *planner->choose_task(state);
      check(state, task);
      simulator.assign(state, allocator->allocate(state, task));
    }
  }
}

TaskId task_named(const LineModel& line, const std::string& name) {
  for (std::size_t t = 0; t < line.tasks.size(); ++t) {
    if (line.tasks[t].name == name) return TaskId(t);
  }
  ADD_FAILURE() << name;
  return TaskId(0);
}

StationId station_named(const LineModel& line, const std::string& name) {
  for (std::size_t s = 0; s < line.stations.size(); ++s) {
    if (line.stations[s].name == name) return StationId(s);
  }
  ADD_FAILURE() << name;
  return StationId(0);
}

/// Ticks from every free human to the cutter, by worker.
std::map<int, Tick> ways_to_cutter(const Simulator& simulator, const SimulationState& state) {
  std::map<int, Tick> ways;
  for (std::size_t w = 0; w < state.workers.size(); ++w) {
    if (!state.workers[w].free() ||
        simulator.line().worker_kinds[static_cast<std::size_t>(state.workers[w].kind)].name !=
            "human")
      continue;
    ways[static_cast<int>(w)] =
        simulator
            .route_from_worker(state, WorkerId(w), station_named(simulator.line(), "cutter_panel"))
            .ticks;
  }
  return ways;
}

TEST(Allocation, SapTakesTheNearestAndLongestPathTheFarthestHuman) {
  const Simulator& simulator = *shipped_line("scenarios/duct_line.yaml").simulator;
  const TaskId cut = task_named(simulator.line(), "cut_straight");
  const auto sap = make_allocator("sap", simulator);
  const auto longest = make_allocator("longest_path", simulator);
  int chosen = 0;
  at_decisions(simulator, [&](const SimulationState& state, TaskId) {
    if (!state.is_selectable(cut)) return;
    ++chosen;
    const auto ways = ways_to_cutter(simulator, state);
    const auto less = [](const auto& a, const auto& b) { return a.second < b.second; };
    EXPECT_EQ(ways.at(sap->allocate(state, cut).members[0]),
              std::min_element(ways.begin(), ways.end(), less)->second);
    EXPECT_EQ(ways.at(longest->allocate(state, cut).members[0]),
              std::max_element(ways.begin(), ways.end(), less)->second);
  });
  EXPECT_GT(chosen, 20);
}

TEST(Allocation, SapTakesRobotAndCageWithTheShortestWayTogether) {
  const Simulator& simulator = *shipped_line("scenarios/duct_line.yaml").simulator;
  const LineModel& line = simulator.line();
  const TaskId bring = task_named(line, "bring_flanges");
  const StationId rack = station_named(line, "flange_rack");
  const auto sap = make_allocator("sap", simulator);
  int chosen = 0;
  at_decisions(simulator, [&](const SimulationState& state, TaskId) {
    if (!state.is_selectable(bring)) return;
    ++chosen;
    const auto cost = [&](std::size_t robot, std::size_t cage) {
      const StationId stands(std::int32_t{state.carriers[cage].station});
      return simulator.route_from_worker(state, WorkerId(robot), stands).ticks +
             line.travel[static_cast<std::size_t>(state.workers[robot].kind)]
                 .leg(stands, rack)
                 .ticks;
    };
    Tick best = kMaxTicks;
    for (std::size_t w = 0; w < state.workers.size(); ++w) {
      if (!state.workers[w].free() ||
          line.worker_kinds[static_cast<std::size_t>(state.workers[w].kind)].name != "robot")
        continue;
      for (std::size_t c = 0; c < state.carriers.size(); ++c) {
        if (state.carriers[c].free() && state.carriers[c].items == 0)
          best = std::min(best, cost(w, c));
      }
    }
    const Assignment assignment = sap->allocate(state, bring);
    std::size_t robot = 0;
    std::size_t cage = 0;
    for (std::size_t slot = 0; slot < line.tasks[bring.index()].crew.size(); ++slot) {
      const std::string& role = line.tasks[bring.index()].crew[slot].role;
      if (role == "robot") robot = static_cast<std::size_t>(assignment.members[slot]);
      if (role == "cage") cage = static_cast<std::size_t>(assignment.members[slot]);
    }
    EXPECT_EQ(cost(robot, cage), best);
  });
  EXPECT_GT(chosen, 10);
}

TEST(Allocation, FirstIdleTakesTheLowestNumbers) {
  const Simulator& simulator = *shipped_line("scenarios/duct_line.yaml").simulator;
  const TaskId cut = task_named(simulator.line(), "cut_straight");
  const auto first = make_allocator("first_idle", simulator);
  at_decisions(simulator, [&](const SimulationState& state, TaskId) {
    if (!state.is_selectable(cut)) return;
    EXPECT_EQ(first->allocate(state, cut).members[0],
              ways_to_cutter(simulator, state).begin()->first);
  });
}

TEST(Allocation, NoSpatialReachesEveryFreeHumanAboutEquallyOften) {
  const Simulator& simulator = *shipped_line("scenarios/duct_line.yaml").simulator;
  const auto random = make_allocator("no_spatial", simulator);
  const TaskId bring = task_named(simulator.line(), "bring_flanges");
  SimulationState state;
  simulator.reset(state, sample_setup(simulator.line(), crew_of({3, 3}), 1));
  simulator.advance(state);
  random->reset(1);
  std::map<std::int16_t, int> humans;
  for (int i = 0; i < 3000; ++i) ++humans[random->allocate(state, bring).members[0]];
  ASSERT_EQ(humans.size(), 3U);
  for (const auto& [human, times] : humans) EXPECT_NEAR(times, 1000, 150) << human;
}

}  // namespace
}  // namespace linewright::testing
