// Recorded runs of the published line, replayed decision by decision: the simulator must have the
// same milestones at the same ticks.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "linewright/allocation/allocator.hpp"
#include "linewright/base/files.hpp"
#include "linewright/evaluation/event_log_writer.hpp"
#include "linewright/evaluation/recorded_run.hpp"
#include "tests/support.hpp"

namespace linewright::testing {
namespace {

std::vector<std::string> recorded_files() {
  std::vector<std::string> files;
  for (const auto& entry :
       std::filesystem::directory_iterator(LINEWRIGHT_SOURCE_DIR "/tests/data/recorded")) {
    files.push_back(entry.path().string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

struct Replayed {
  RecordedRun recorded;
  ReplayResult result;
  LoggedRun run;
  std::vector<MilestoneComparison> milestones;
};

Replayed replay_file(const std::string& file, const Line& line) {
  Replayed replayed;
  replayed.recorded = load_recorded_run(file, line.simulator->line());
  const auto fallback = make_allocator("first_idle", *line.simulator);
  replayed.result = replay(*line.simulator, replayed.run.state, replayed.recorded.setup,
                           replayed.recorded.decisions, *fallback, &replayed.run.log);
  replayed.milestones =
      compare_milestones(replayed.recorded, line.simulator->line(), replayed.run.log);
  return replayed;
}

class RecordedRuns : public ::testing::TestWithParam<std::string> {};

TEST_P(RecordedRuns, HaveTheirMilestonesAndMakespan) {
  const Replayed replayed =
      replay_file(GetParam(), shipped_line("scenarios/duct_line_published.yaml"));
  Tick largest = 0;
  std::size_t exact = 0;
  for (const MilestoneComparison& milestone : replayed.milestones) {
    ASSERT_TRUE(milestone.ours) << milestone.recorded.name << " " << milestone.recorded.label
                                << " at " << milestone.recorded.tick << " never happened";
    const Tick difference = std::abs(*milestone.ours - milestone.recorded.tick);
    largest = std::max(largest, difference);
    exact += difference == 0 ? 1 : 0;
    EXPECT_LE(difference, 5) << milestone.recorded.name << " " << milestone.recorded.label << " at "
                             << milestone.recorded.tick;
  }
  EXPECT_FALSE(replayed.milestones.empty());
  const SimulationState& state = replayed.run.state;
  if (replayed.recorded.finished.value_or(true)) {
    ASSERT_EQ(state.status, RunStatus::kFinished);
    ASSERT_TRUE(replayed.recorded.makespan);
    EXPECT_LE(std::abs(state.now - *replayed.recorded.makespan), *replayed.recorded.makespan / 100);
  } else {
    EXPECT_EQ(state.status, RunStatus::kDeadlock);
  }
  fmt::print(
      "{:<28} makespan recorded {:>5} ours {:>9}   milestones {:>3}, exact {:>3}, largest "
      "difference {}\n",
      std::filesystem::path(GetParam()).stem().string(),
      replayed.recorded.makespan ? std::to_string(*replayed.recorded.makespan) : "-",
      state.status == RunStatus::kFinished ? std::to_string(state.now) : "deadlock",
      replayed.milestones.size(), exact, largest);
}

INSTANTIATE_TEST_SUITE_P(All, RecordedRuns, ::testing::ValuesIn(recorded_files()),
                         [](const ::testing::TestParamInfo<std::string>& scenario) {
                           return std::filesystem::path(scenario.param).stem().string();
                         });

TEST(Replay, OfAnEventLogGivesTheSameLog) {
  const Line& line = shipped_line("scenarios/duct_line.yaml");
  const LoggedRun run = run_line(line, crew_of({3, 2}), 7, "random", "no_spatial");
  const std::string file = ::testing::TempDir() + "/linewright_replay.jsonl";
  write_file(file, run.text);
  const Replayed replayed = replay_file(file, line);
  EXPECT_EQ(
      event_log_text(line.scenario, replayed.run.log, line.simulator->progress(replayed.run.state)),
      run.text);
  std::filesystem::remove(file);
}

TEST(Replay, SaysWhichDecisionWasNotPossible) {
  const Line& line = shipped_line("scenarios/duct_line.yaml");
  const auto file = std::string(LINEWRIGHT_SOURCE_DIR "/tests/data/recorded/rule_H1R1_n5_s0.json");
  RecordedRun recorded = load_recorded_run(file, line.simulator->line());
  // Storing before anything was collected can never become possible.
  for (std::size_t t = 0; t < line.scenario.line.tasks.size(); ++t) {
    if (line.scenario.line.tasks[t].name == "store_ducts") recorded.decisions[0].task = TaskId(t);
  }
  recorded.decisions.resize(1);
  SimulationState state;
  const auto fallback = make_allocator("first_idle", *line.simulator);
  const ReplayResult result =
      replay(*line.simulator, state, recorded.setup, recorded.decisions, *fallback);
  ASSERT_EQ(result.decisions.size(), 1U);
  EXPECT_FALSE(result.decisions[0].taken);
  EXPECT_NE(result.decisions[0].refusal.find("store_ducts is not selectable"), std::string::npos);
}

}  // namespace
}  // namespace linewright::testing
