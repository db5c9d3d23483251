// Whom the allocators choose, against plain enumerations of everyone who is free.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "linewright/allocation/advance.hpp"
#include "linewright/allocation/allocator.hpp"
#include "linewright/planning/episode.hpp"
#include "linewright/planning/planner.hpp"
#include "tests/plain_allocator.hpp"
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
      const TaskId task = *planner->decide(state, all_choices(simulator, state)).task;
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

/// Fills `state` with `count` workers of each kind and as many carriers, of random whereabouts:
/// free or not, some under way, some carriers taken or not empty. Ties are frequent.
void scatter(const LineModel& line, SimulationState& state, std::size_t count,
             RandomStream& random) {
  const auto station_of = [&](std::size_t kind) {
    while (true) {
      const std::size_t station = random.below(line.stations.size());
      if (line.stations[station].poses[kind]) return static_cast<std::int16_t>(station);
    }
  };
  state.workers.clear();
  state.now = 100;
  for (std::size_t kind = 0; kind < line.worker_kinds.size(); ++kind) {
    for (std::size_t i = 0; i < count; ++i) {
      WorkerState worker;
      worker.kind = static_cast<std::int16_t>(kind);
      worker.station = station_of(kind);
      worker.from = station_of(kind);
      worker.execution = random.below(4) == 0 ? 0 : -1;
      if (random.below(3) == 0) {
        worker.depart = random.between(80, 110);
        worker.arrive = worker.depart + random.between(1, 40);
      }
      state.workers.push_back(worker);
    }
  }
  state.carriers.clear();
  for (std::size_t kind = 0; kind < line.carrier_kinds.size(); ++kind) {
    for (std::size_t i = 0; i < count; ++i) {
      CarrierState carrier;
      carrier.kind = static_cast<std::int16_t>(kind);
      carrier.station = station_of(line.carrier_kinds[kind].moved_by.index());
      carrier.execution = random.below(4) == 0 ? 0 : -1;
      carrier.items = random.below(3) == 0 ? 1 : 0;
      state.carriers.push_back(carrier);
    }
  }
}

class GroupedChoice : public ::testing::TestWithParam<std::string> {};

TEST_P(GroupedChoice, IsThatOfThePlainSearchForEveryRule) {
  const Line& line = shipped_line(GetParam());
  const Simulator& simulator = *line.simulator;
  SimulationState state;
  simulator.reset(state, sample_setup(simulator.line(), {}, 1));
  RandomStream random(7);
  for (const std::string& name : allocator_names()) {
    const auto grouped = make_allocator(name, simulator);
    PlainAllocator plain(name, simulator);
    for (int round = 0; round < 40; ++round) {
      // Up to 120 of each: more pairs than `no_spatial` makes draws for.
      scatter(simulator.line(), state, 1 + random.below(round % 4 == 0 ? 120 : 12), random);
      grouped->reset(static_cast<std::uint64_t>(round));
      plain.reset(static_cast<std::uint64_t>(round));
      for (std::size_t t = 0; t < simulator.line().tasks.size(); ++t) {
        EXPECT_EQ(grouped->allocate(state, TaskId(t)).members,
                  plain.allocate(state, TaskId(t)).members)
            << name << ", task " << simulator.line().tasks[t].name << ", round " << round;
      }
    }
  }
}

TEST_P(GroupedChoice, IsThatOfThePlainSearchForEveryJoiner) {
  const Line& line = shipped_line(GetParam());
  const Simulator& simulator = *line.simulator;
  SimulationState state;
  simulator.reset(state, sample_setup(simulator.line(), {}, 1));
  RandomStream random(8);
  for (const std::string& name : allocator_names()) {
    const auto grouped = make_allocator(name, simulator);
    PlainAllocator plain(name, simulator);
    for (std::size_t t = 0; t < simulator.line().tasks.size(); ++t) {
      scatter(simulator.line(), state, 20, random);
      Execution& execution = state.executions.at(0);
      execution.task = static_cast<std::int16_t>(t);
      execution.members = plain.allocate(state, TaskId(t)).members;
      const auto& crew = simulator.line().tasks[t].crew;
      for (std::size_t slot = 0; slot < crew.size(); ++slot) {
        if (!crew[slot].worker) continue;
        grouped->reset(t);
        plain.reset(t);
        EXPECT_EQ(grouped->join(state, {0, slot}), plain.join(state, {0, slot})) << name;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Lines, GroupedChoice,
                         ::testing::Values("scenarios/duct_line.yaml",
                                           "scenarios/teaching/kitting_cell.yaml",
                                           "tests/data/awkward/two_joiners_at_once.yaml"));

TEST(Allocation, SnappingDiffersOnlyForWorkersUnderWay) {
  const Simulator& simulator = *shipped_line("scenarios/duct_line.yaml").simulator;
  const LineModel& line = simulator.line();
  const TaskId cut = task_named(line, "cut_straight");
  SimulationState state;
  simulator.reset(state, sample_setup(line, crew_of({2, 1}), 1));
  simulator.advance(state);
  const auto put = [&](std::size_t worker, const char* from, const char* to) {
    state.workers[worker].from = static_cast<std::int16_t>(station_named(line, from).value);
    state.workers[worker].station = static_cast<std::int16_t>(station_named(line, to).value);
  };
  put(0, "bend_table", "bend_table");
  put(1, "cutter_panel", "flange_rack");
  const auto sap = make_allocator("sap", simulator);
  const auto snapped = make_allocator("sap_snapped", simulator);
  EXPECT_EQ(sap->allocate(state, cut).members[0], 0);
  EXPECT_EQ(snapped->allocate(state, cut).members[0], 0);
  // Just set out from the cutter, it still counts as standing there; `sap` knows that its way back
  // leads over the flange rack.
  state.workers[1].depart = state.now;
  state.workers[1].arrive = state.now + 30;
  EXPECT_EQ(sap->allocate(state, cut).members[0], 0);
  EXPECT_EQ(snapped->allocate(state, cut).members[0], 1);
}

}  // namespace
}  // namespace linewright::testing
