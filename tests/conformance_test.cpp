// What every scenario, planner and allocator has to keep to, on all scenarios of the repository.

#include <gtest/gtest.h>

#include <set>

#include "linewright/allocation/advance.hpp"
#include "linewright/allocation/allocator.hpp"
#include "linewright/evaluation/event_log_writer.hpp"
#include "linewright/evaluation/recorded_run.hpp"
#include "linewright/planning/episode.hpp"
#include "linewright/planning/planner.hpp"
#include "tests/log_audit.hpp"
#include "tests/support.hpp"

namespace linewright::testing {
namespace {

class EveryLine : public ::testing::TestWithParam<std::string> {};

TEST_P(EveryLine, ConservesTokensMachinesAndPeople) {
  const Line& line = shipped_line(GetParam());
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const LoggedRun run =
        run_line(line, {}, seed, seed % 2 == 0 ? "random" : "first", "no_spatial");
    const Audit audit(run.text);
    ASSERT_EQ(audit.problem, "") << "seed " << seed;
    const Order& order = line.scenario.line.order;
    const Variable finished{VariableKind::kPlaceCount, order.finished_in.value};
    EXPECT_EQ(audit.count(line.scenario.line.places[order.finished_in.index()].name),
              line.simulator->value(run.state, finished));
  }
}

TEST_P(EveryLine, ReplaysItsOwnLogs) {
  const Line& line = shipped_line(GetParam());
  const auto fallback = make_allocator("first_idle", *line.simulator);
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const LoggedRun run = run_line(line, {}, seed, "random", "no_spatial");
    const RecordedRun recorded = read_recorded_run(run.text, "log", line.simulator->line());
    LoggedRun again;
    replay(*line.simulator, again.state, recorded.setup, recorded.decisions, *fallback, &again.log);
    EXPECT_EQ(event_log_text(line.scenario, again.log, line.simulator->progress(again.state)),
              run.text)
        << "seed " << seed;
  }
}

std::vector<std::string> all_lines() {
  std::vector<std::string> files = shipped_scenarios();
  for (const std::string& file : awkward_scenarios()) files.push_back(file);
  return files;
}

INSTANTIATE_TEST_SUITE_P(All, EveryLine, ::testing::ValuesIn(all_lines()),
                         [](const ::testing::TestParamInfo<std::string>& scenario) {
                           return std::filesystem::path(scenario.param).stem().string();
                         });

TEST(WaitingAction, StartsInTheTickInWhichAnOperationMakesRoom) {
  const Line& line = shipped_line("tests/data/awkward/waiting_for_room.yaml");
  const LoggedRun run = run_line(line, {}, 1, "first", "sap");
  EXPECT_NE(run.text.find("{\"t\":2,\"event\":\"transfer\""), std::string::npos) << run.text;
}

TEST(Milestone, OfABerthIsNotedWhenAWorkerPutsTheItemIn) {
  const Line& line = shipped_line("tests/data/awkward/milestone_of_a_berth.yaml");
  EXPECT_NE(run_line(line, {}, 1, "first", "sap").text.find("in_bay"), std::string::npos);
}

class EveryScenario : public ::testing::TestWithParam<std::string> {};

TEST_P(EveryScenario, GivesTheSameLogForTheSameSeedAndAnotherForAnother) {
  const Line& line = shipped_line(GetParam());
  std::set<std::string> logs;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const LoggedRun run = run_line(line, {}, seed, "random", "no_spatial");
    EXPECT_EQ(run.text, run_line(line, {}, seed, "random", "no_spatial").text);
    logs.insert(run.text);
  }
  EXPECT_GT(logs.size(), 1U);
}

TEST_P(EveryScenario, MakesOnlySelectableTasksAssignable) {
  const Line& line = shipped_line(GetParam());
  const Simulator& simulator = *line.simulator;
  for (const std::string& name : allocator_names()) {
    const auto allocator = make_allocator(name, simulator);
    const auto planner = PlannerRegistry::make("random", simulator);
    SimulationState state;
    simulator.reset(state, sample_setup(simulator.line(), {}, 3));
    planner->reset(3);
    allocator->reset(3);
    while (advance_and_join(simulator, state, *allocator) == RunStatus::kDecision) {
      for (std::size_t t = 0; t < simulator.line().tasks.size(); ++t) {
        const TaskId task(t);
        EXPECT_EQ(state.is_selectable(task), simulator.explain_unselectable(state, task).empty());
        const Assignment assignment =
            state.is_selectable(task) ? allocator->allocate(state, task) : Assignment(task);
        EXPECT_EQ(simulator.explain_refusal(state, assignment).empty(), state.is_selectable(task));
      }
      const auto task = planner->decide(state, all_choices(simulator, state)).task;
      ASSERT_TRUE(task);
      ASSERT_TRUE(simulator.assign(state, allocator->allocate(state, *task)));
    }
    EXPECT_TRUE(state.ended());
  }
}

TEST_P(EveryScenario, IsFinishedByTheFirstTaskRule) {
  const Line& line = shipped_line(GetParam());
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    EXPECT_EQ(run_line(line, {}, seed, "first", "sap").state.status, RunStatus::kFinished) << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(All, EveryScenario, ::testing::ValuesIn(shipped_scenarios()),
                         [](const ::testing::TestParamInfo<std::string>& scenario) {
                           std::string name = std::filesystem::path(scenario.param).stem().string();
                           return name;
                         });

TEST(Allocators, AgreeWhenThereIsNothingToChoose) {
  const Line& line = shipped_line("scenarios/duct_line.yaml");
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const std::string sap = run_line(line, crew_of({1, 1}), seed, "first", "sap").text;
    for (const std::string& other : allocator_names()) {
      EXPECT_EQ(run_line(line, crew_of({1, 1}), seed, "first", other).text, sap) << other;
    }
  }
}

TEST(Allocators, DifferWhenThereIs) {
  const Line& line = shipped_line("scenarios/duct_line.yaml");
  std::set<std::string> logs;
  for (const char* name : {"sap", "no_spatial", "longest_path", "first_idle"}) {
    logs.insert(run_line(line, crew_of({3, 3}), 1, "first", name).text);
  }
  EXPECT_EQ(logs.size(), 4U);
}

TEST(Allocators, SnappedIsSapWhileFreeWorkersStand) {
  const Line& line = shipped_line("scenarios/duct_line.yaml");
  EXPECT_EQ(run_line(line, crew_of({3, 3}), 1, "random", "sap_snapped").text,
            run_line(line, crew_of({3, 3}), 1, "random", "sap").text);
}

}  // namespace
}  // namespace linewright::testing
