// No run of any line is ever faster than its lower bounds, and where the best possible is known
// they come near it.

#include <gtest/gtest.h>

#include <algorithm>

#include "linewright/allocation/advance.hpp"
#include "linewright/allocation/allocator.hpp"
#include "linewright/base/random.hpp"
#include "linewright/bounds/lower_bounds.hpp"
#include "linewright/planning/shield.hpp"
#include "linewright/planning/solve.hpp"
#include "tests/support.hpp"

namespace linewright::testing {
namespace {

/// How a run is played: tasks at random or the lowest first, waiting now and then.
struct Play {
  bool first = false;
  std::uint64_t wait_percent = 0;
  std::string allocator = "sap";
};

/// A run in which any legal decision may be taken, waiting included, whatever the line allows
/// planners. Kept out of dead states so that most runs finish.
std::optional<Tick> makespan_of(const Simulator& simulator, const RunSetup& setup, const Play& play,
                                std::uint64_t seed) {
  auto random = RandomStream::derive(seed, "play");
  const auto allocator = make_allocator(play.allocator, simulator);
  allocator->reset(seed);
  Shield shield(simulator, {.rollouts = 6, .max_states = 300});
  SimulationState state;
  simulator.reset(state, setup);
  while (advance_and_join(simulator, state, *allocator) == RunStatus::kDecision) {
    std::vector<TaskId> tasks;
    for (std::size_t t = 0; t < simulator.line().tasks.size(); ++t) {
      if (state.is_selectable(TaskId(t))) tasks.emplace_back(t);
    }
    if (random.below(100) < play.wait_percent && simulator.wait(state)) continue;
    bool taken = false;
    while (!taken && !tasks.empty()) {
      const std::size_t choice = play.first ? 0 : random.below(tasks.size());
      SimulationState after = state;
      simulator.assign(after, allocator->allocate(state, tasks[choice]));
      taken = shield.judge(after) != Shield::Verdict::kFatal;
      if (taken) state = after;
      tasks.erase(tasks.begin() + static_cast<std::ptrdiff_t>(choice));
    }
    if (!taken && !simulator.wait(state)) return std::nullopt;
  }
  if (state.status != RunStatus::kFinished) return std::nullopt;
  return state.now;
}

/// A crew, an order and a start that the line can have.
RunSetup random_setup(const LineModel& line, std::uint64_t seed) {
  auto random = RandomStream::derive(seed, "crew");
  RunOptions options;
  for (const WorkerKind& kind : line.worker_kinds) {
    const int most = std::min(kind.count.max, kind.count.min + 2);
    options.workers.emplace_back(
        kind.count.min +
        static_cast<int>(random.below(static_cast<std::uint64_t>(most - kind.count.min + 1))));
  }
  options.order = 1 + static_cast<int>(random.below(5));
  return sample_setup(line, options, seed);
}

Play random_play(std::uint64_t seed) {
  auto random = RandomStream::derive(seed, "how");
  const auto& allocators = allocator_names();
  return {.first = random.below(2) == 0,
          .wait_percent = random.below(3) * 15,
          .allocator = allocators[random.below(allocators.size())]};
}

class EveryLineIsBounded : public ::testing::TestWithParam<std::string> {};

TEST_P(EveryLineIsBounded, NoRunIsFasterThanAnyBound) {
  const Line& line = shipped_line(GetParam());
  const Simulator& simulator = *line.simulator;
  std::size_t finished = 0;
  const std::uint64_t setups = GetParam().starts_with("scenarios") ? 30 : 8;
  for (std::uint64_t seed = 1; seed <= setups; ++seed) {
    const RunSetup setup = random_setup(simulator.line(), seed);
    const auto bounds = lower_bounds(simulator.line(), setup, {.most_states = 200});
    for (std::uint64_t run = 0; run < 10; ++run) {
      const Play play = random_play(seed * 1000 + run);
      const auto makespan = makespan_of(simulator, setup, play, seed * 1000 + run);
      if (!makespan) continue;
      ++finished;
      for (const Bound& bound : bounds) {
        ASSERT_LE(bound.ticks, *makespan)
            << bound.name << ", seed " << seed << ", order " << setup.order << ", run " << run;
      }
    }
  }
  RecordProperty("finished", static_cast<int>(finished));
}

std::vector<std::string> lines_with_bounds() {
  std::vector<std::string> files = shipped_scenarios();
  for (const std::string& file : awkward_scenarios()) files.push_back(file);
  return files;
}

INSTANTIATE_TEST_SUITE_P(All, EveryLineIsBounded, ::testing::ValuesIn(lines_with_bounds()),
                         [](const ::testing::TestParamInfo<std::string>& scenario) {
                           return std::filesystem::path(scenario.param).stem().string();
                         });

TEST(LowerBounds, OfTheDuctLineAreAboveTheStationCycle) {
  const LineModel& line = shipped_line("scenarios/duct_line.yaml").scenario.line;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const RunSetup setup = sample_setup(line, crew_of({3, 3}, 5), seed);
    const auto bounds = lower_bounds(line, setup);
    EXPECT_GE(bounds[0].ticks, 610) << seed;
    EXPECT_LE(bounds[0].ticks, 655) << seed;  // runs of 655 ticks are known
  }
}

TEST(LowerBounds, OfOnePersonCountFullCagesAndFixturesThatAreHeld) {
  // One person fetches four flanges before the fifth, and brings none to a fixture that holds one.
  const LineModel& line = shipped_line("scenarios/duct_line.yaml").scenario.line;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const auto bounds = lower_bounds(line, sample_setup(line, crew_of({1, 2}, 5), seed));
    EXPECT_EQ(bounds[0].name, "worker:human");
    EXPECT_GE(bounds[0].ticks, 781) << seed;
    EXPECT_LE(bounds[0].ticks, 832) << seed;  // runs of 832 ticks are known
  }
}

TEST(LowerBounds, AreBelowWhatASearchFinds) {
  const Line& line = shipped_line("scenarios/duct_line.yaml");
  for (const int order : {1, 2, 4}) {
    for (const std::vector<int>& crew : {std::vector{1, 1}, std::vector{1, 3}, std::vector{2, 2}}) {
      const RunSetup setup = sample_setup(line.scenario.line, crew_of(crew, order), 1);
      const Solution found =
          solve(*line.simulator, setup, {.free_agents = true, .wait = true, .rollouts = 300}, {});
      ASSERT_TRUE(found.finished);
      EXPECT_LE(lower_bounds(line.scenario.line, setup)[0].ticks, found.makespan) << order;
    }
  }
}

TEST(LowerBounds, GrowWithTheOrder) {
  const LineModel& line = shipped_line("scenarios/duct_line.yaml").scenario.line;
  Tick before = 0;
  for (int order = 1; order <= 8; ++order) {
    const Tick bound = lower_bounds(line, sample_setup(line, crew_of({2, 2}, order), 1))[0].ticks;
    EXPECT_GT(bound, before) << order;
    before = bound;
  }
}

TEST(LowerBounds, HoldForAnOrderBeyondWhatIsCounted) {
  // Nothing is counted beyond 127.
  const Line& line = shipped_line("scenarios/teaching/one_human_one_robot.yaml");
  RunOptions options;
  options.order = 130;
  options.horizon = 100'000;
  const RunSetup setup = sample_setup(line.scenario.line, options, 1);
  const auto makespan = makespan_of(*line.simulator, setup, {.first = true}, 1);
  ASSERT_TRUE(makespan);
  for (const Bound& bound : lower_bounds(line.scenario.line, setup, {.most_states = 20}))
    EXPECT_LE(bound.ticks, *makespan) << bound.name;
}

TEST(LowerBounds, OfALineOfOnePersonAreTheBestPossible) {
  // Fetch, press, store, one after the other: nothing can be done at the same time.
  const Line& line = shipped_line("scenarios/teaching/one_human_one_robot.yaml");
  for (int order = 1; order <= 4; ++order) {
    RunOptions options;
    options.order = order;
    const RunSetup setup = sample_setup(line.scenario.line, options, 1);
    Tick best = kMaxTicks;
    for (std::uint64_t seed = 1; seed <= 300; ++seed) {
      const auto makespan = makespan_of(*line.simulator, setup, {.wait_percent = seed % 20}, seed);
      if (makespan) best = std::min(best, *makespan);
    }
    EXPECT_EQ(lower_bounds(line.scenario.line, setup)[0].ticks, best) << order;
  }
}

TEST(LowerBounds, SayThatACrewCanNeverFinish) {
  const LineModel& line = shipped_line("scenarios/duct_line.yaml").scenario.line;
  RunSetup setup = sample_setup(line, crew_of({2, 2}, 5), 1);
  setup.worker_start[1].clear();  // without robots nothing is ever brought
  const auto bounds = lower_bounds(line, setup);
  EXPECT_EQ(bounds[0].ticks, kMaxTicks);
  EXPECT_NE(bounds[0].argument.find("never finish"), std::string::npos);
}

TEST(LowerBounds, AreTheSameEveryTime) {
  const LineModel& line = shipped_line("scenarios/teaching/kitting_cell.yaml").scenario.line;
  const RunSetup setup = sample_setup(line, {}, 3);
  const auto once = lower_bounds(line, setup);
  const auto again = lower_bounds(line, setup);
  ASSERT_EQ(once.size(), again.size());
  for (std::size_t i = 0; i < once.size(); ++i) {
    EXPECT_EQ(once[i].ticks, again[i].ticks);
    EXPECT_EQ(once[i].argument, again[i].argument);
  }
}

TEST(Gap, IsRelativeToTheLowerBound) { EXPECT_DOUBLE_EQ(gap(750, 600), 0.25); }

}  // namespace
}  // namespace linewright::testing
