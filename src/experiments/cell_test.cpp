#include "linewright/experiments/cell.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "linewright/base/diagnostic.hpp"
#include "linewright/base/files.hpp"
#include "linewright/evaluation/crews.hpp"
#include "linewright/scenario/load.hpp"

namespace linewright {
namespace {

std::int64_t no_time() { return 0; }

const Scenario& kitting() {
  static const Scenario kScenario =
      load_scenario(LINEWRIGHT_SOURCE_DIR "/scenarios/teaching/kitting_cell.yaml");
  return kScenario;
}

const ExperimentCell kCell{.planner = "random", .order = 2, .trials = 4, .seed = 9};

TEST(Cell, PlaysWhatRunTrialsPlays) {
  const auto result = run_cell(kCell, kitting(), no_time);
  ASSERT_TRUE(result);
  std::vector<RunOptions> crews = all_crews(kitting().line);
  for (RunOptions& crew : crews) crew.order = 2;
  const auto trials =
      run_trials(kitting(), {.planner = "random"}, {.crews = crews, .trials = 4, .seed = 9});
  ASSERT_EQ(result->crews.size(), trials.size());
  for (std::size_t c = 0; c < trials.size(); ++c) {
    EXPECT_EQ(result->crews[c].name, crew_name(kitting().line, crews[c]));
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_EQ(result->crews[c].makespan[i], trials[c][i].makespan);
      EXPECT_EQ(result->crews[c].progress[i], trials[c][i].progress);
      EXPECT_EQ(result->crews[c].decisions[i], trials[c][i].decisions);
    }
  }
}

TEST(Cell, StopsWhenCancelled) {
  CancelToken cancel;
  cancel.request();
  EXPECT_FALSE(run_cell(kCell, kitting(), no_time, {}, &cancel));
}

TEST(Cell, HasAKeyOfWhatMatters) {
  const std::string key = key_of(kCell, kitting());
  EXPECT_EQ(key.size(), 16U);
  const auto changed = [&](auto change) {
    ExperimentCell cell = kCell;
    change(cell);
    return key_of(cell, kitting());
  };
  EXPECT_EQ(changed([](auto&) {}), key);
  EXPECT_NE(changed([](auto& c) { c.planner = "first"; }), key);
  EXPECT_NE(changed([](auto& c) { c.allocator = "no_spatial"; }), key);
  EXPECT_NE(changed([](auto& c) { c.order = 3; }), key);
  EXPECT_NE(changed([](auto& c) { c.horizon = 300; }), key);
  EXPECT_NE(changed([](auto& c) { c.trials = 5; }), key);
  EXPECT_NE(changed([](auto& c) { c.seed = 5; }), key);
  EXPECT_NE(changed([](auto& c) { c.shield = true; }), key);
}

TEST(Cell, HasTheBoundsOfTheSameStarts) {
  const ExperimentCell cell{.bound = "combined", .order = 2, .trials = 3, .seed = 9};
  const auto bounds = run_cell(cell, kitting(), no_time);
  const auto played =
      run_cell({.planner = "first", .order = 2, .trials = 3, .seed = 9}, kitting(), no_time);
  ASSERT_TRUE(bounds && played);
  ASSERT_EQ(bounds->crews.size(), played->crews.size());
  for (std::size_t c = 0; c < bounds->crews.size(); ++c) {
    EXPECT_EQ(bounds->crews[c].name, played->crews[c].name);
    EXPECT_TRUE(bounds->crews[c].finished.empty());
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_GT(bounds->crews[c].makespan[i], 0);
      EXPECT_LE(bounds->crews[c].makespan[i], played->crews[c].makespan[i]);
    }
  }
  EXPECT_NE(key_of(cell, kitting()),
            key_of({.planner = "first", .order = 2, .trials = 3, .seed = 9}, kitting()));
  CancelToken cancel;
  cancel.request();
  EXPECT_FALSE(run_cell(cell, kitting(), no_time, {}, &cancel));
}

TEST(Cell, HasOneKeyWithABudgetInTime) {
  ExperimentCell cell = kCell;
  cell.planner = "lookahead:1ms";
  EXPECT_EQ(key_of(cell, kitting()), key_of(cell, kitting()));
  cell.planner = "lookahaed:1ms";
  EXPECT_THROW(static_cast<void>(key_of(cell, kitting())), ScenarioError);
}

/// A folder that goes away again.
class Store : public testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string folder_ = testing::TempDir() + "/linewright_cells_" + std::to_string(getpid());
  CellStore store_{folder_};
};

TEST_F(Store, KeepsAResult) {
  const CellResult result = run_cell(kCell, kitting(), no_time).value();
  EXPECT_FALSE(store_.find("0123456789abcdef"));
  store_.keep("0123456789abcdef", kCell, result);
  const CellResult again = store_.find("0123456789abcdef").value();
  ASSERT_EQ(again.crews.size(), result.crews.size());
  for (std::size_t c = 0; c < result.crews.size(); ++c) {
    EXPECT_EQ(again.crews[c].name, result.crews[c].name);
    EXPECT_EQ(again.crews[c].makespan, result.crews[c].makespan);
    EXPECT_EQ(again.crews[c].finished, result.crews[c].finished);
    EXPECT_EQ(again.crews[c].progress, result.crews[c].progress);
    EXPECT_EQ(again.crews[c].distance_m, result.crews[c].distance_m);
    EXPECT_EQ(again.crews[c].decisions, result.crews[c].decisions);
  }
}

TEST_F(Store, KeepsBounds) {
  const ExperimentCell cell{.bound = "combined", .order = 1, .trials = 1};
  const CellResult result = run_cell(cell, kitting(), no_time).value();
  store_.keep("0123456789abcdef", cell, result);
  const CellResult again = store_.find("0123456789abcdef").value();
  EXPECT_EQ(again.crews.at(0).makespan, result.crews.at(0).makespan);
  EXPECT_TRUE(again.crews.at(0).progress.empty());
}

TEST_F(Store, RefusesWhatIsNoResult) {
  const std::string file = folder_ + "/0123456789abcdef.json";
  for (
      const char* text :
      {"", "{}", "[1]", R"({"format":"linewright/cell/3","key":"x"})",
       R"({"format":"linewright/cell/3","key":"0123456789abcdef","wall_s":1,"bound":"","crews":[]})",
       R"({"format":"linewright/cell/3","key":"0123456789abcdef","wall_s":1,"bound":"","crews":[{"crew":"A",)"
       R"("makespan":[1],"finished":[],"progress":[1],"distance_m":[1],"decisions":[1]}]})"}) {
    write_file(file, text);
    EXPECT_THROW(static_cast<void>(store_.find("0123456789abcdef")), ScenarioError) << text;
  }
}

}  // namespace
}  // namespace linewright
