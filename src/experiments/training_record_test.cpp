#include "linewright/experiments/training_record.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "linewright/base/diagnostic.hpp"
#include "linewright/base/files.hpp"
#include "linewright/experiments/figures.hpp"
#include "linewright/experiments/table.hpp"

namespace linewright {
namespace {

/// A run of 300 updates in 60 seconds that comes to `best` at update 200.
TrainingRecord run(double best) {
  TrainingRecord record;
  record.progress.columns = {"updates",  "episodes", "decisions",  "reward",
                             "makespan", "progress", "wall_time_s"};
  record.progress.rows = {{100, 10, 500, -9, 1100, 0.5, 1000},
                          {200, 20, 1000, -8, 1000, 0.8, 1020},
                          {300, 30, 1500, -7, 900, 1.0, 1060}};
  record.evaluations.columns = {"updates", "makespan", "success", "progress"};
  record.evaluations.rows = {
      {100, best - 10, 0.9, 0.95}, {200, best, 1.0, 1.0}, {300, best + 1, 1.0, 1.0}};
  return record;
}

TEST(TrainingRecord, SaysHowLongItTook) {
  const TrainingRecord record = run(800);
  EXPECT_DOUBLE_EQ(*record.minutes(), 1.0);
  EXPECT_DOUBLE_EQ(*record.minutes_until(150), 20.0 / 60.0);
  EXPECT_FALSE(record.minutes_until(301));
  EXPECT_DOUBLE_EQ(*record.last("episodes"), 30.0);
  EXPECT_FALSE(record.last("weather"));
  EXPECT_DOUBLE_EQ(*record.best_makespan(), 800.0);  // not 790: a run failed there
  EXPECT_DOUBLE_EQ(*record.updates_until(800.5), 200.0);
  EXPECT_FALSE(record.updates_until(799));
  EXPECT_FALSE(TrainingRecord{}.minutes());
  EXPECT_FALSE(TrainingRecord{}.best_makespan());
}

Experiment two_algorithms() {
  Experiment experiment{.name = "training", .title = "Training", .paper = "time", .base = "A"};
  experiment.columns = Experiment::Columns::kTraining;
  experiment.metrics = {Metric::kTraining};
  experiment.rows = {{.name = "A", .algorithm = "a", .paper = "A"},
                     {.name = "B", .algorithm = "b"}};
  experiment.claims = {{.says = "B is sooner",
                        .lower = "B",
                        .than = "A",
                        .metric = Metric::kTraining,
                        .column = "updates to 5 %"}};
  return experiment;
}

TEST(TrainingTable, ComparesWhatTheRunsWroteAndThePaper) {
  PaperTables paper;
  paper.tables["time"] = {.columns = {"minutes"}};
  paper.tables["time"].values[Metric::kTraining]["A"] = {100.0};
  // 900 is not within 5 % of 800: the first row's second run counts with its whole length.
  const ExperimentResult result =
      make_training_table(two_algorithms(), {{run(800), run(900)}, {run(800), run(810)}}, &paper);
  const ResultTable& table = result.tables.at(0);
  EXPECT_EQ(table.columns, training_columns());
  const auto value = [&](std::size_t row, const std::string& column) {
    std::size_t at = 0;
    while (table.columns.at(at) != column) ++at;
    return table.rows.at(row).values.at(at);
  };
  EXPECT_DOUBLE_EQ(*value(0, "minutes").mean, 1.0);
  EXPECT_DOUBLE_EQ(*value(0, "minutes").paper, 100.0);
  EXPECT_DOUBLE_EQ(*value(0, "minutes").ratio(), 0.01);
  EXPECT_DOUBLE_EQ(*value(0, "best makespan").mean, 850.0);
  EXPECT_DOUBLE_EQ(*value(0, "updates to 5 %").mean, 250.0);
  EXPECT_DOUBLE_EQ(*value(1, "updates to 5 %").mean, 200.0);
  EXPECT_DOUBLE_EQ(result.claims.at(0).difference.mean, -50.0);
}

TEST(TrainingTable, HasNoNumbersWithoutRecords) {
  const ExperimentResult result = make_training_table(two_algorithms(), {{run(800)}, {}});
  for (const TableValue& value : result.tables[0].rows[1].values) EXPECT_FALSE(value.mean);
  EXPECT_EQ(result.claims.at(0).verdict, JudgedClaim::Verdict::kOpen);
}

TEST(TrainingFigures, HaveABandOfSeedsAndLeaveOutWhatWasNotKept) {
  TrainingRecord short_run = run(810);
  short_run.evaluations.rows.pop_back();  // interrupted
  const Experiment experiment = two_algorithms();
  const auto figures =
      training_figures(experiment, {{run(800), short_run}, {run(900)}}, styles_of({experiment}));
  ASSERT_EQ(figures.size(), 6U);
  EXPECT_EQ(figures[0].name, "training_training_return");
  for (const Figure& figure : figures) {
    EXPECT_NE(figure.svg.find("lw-band"), std::string::npos) << figure.name;
    EXPECT_EQ(figure.svg.find("nan"), std::string::npos) << figure.name;
  }
  TrainingRecord bare = run(800);
  bare.progress = {};
  EXPECT_EQ(training_figures(experiment, {{bare}, {}}, {}).size(), 3U);
  EXPECT_TRUE(training_figures(experiment, {{}, {}}, {}).empty());
}

TEST(NumberTable, SaysWhatIsWrongAndWhere) {
  const std::string file =
      testing::TempDir() + "/linewright_numbers_" + std::to_string(getpid()) + ".csv";
  const auto complaint = [&](const std::string& text) -> std::string {
    write_file(file, text);
    try {
      static_cast<void>(load_number_table(file));
    } catch (const ScenarioError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(complaint("a,b\n1,2.5\n-3e2,0\n"), "");
  EXPECT_EQ(load_number_table(file).rows, (std::vector<std::vector<double>>{{1, 2.5}, {-300, 0}}));
  EXPECT_NE(complaint("a,b\n1,2\n1,x\n").find(file + ":3"), std::string::npos);
  EXPECT_NE(complaint("a,b\n1\n").find("1 numbers for 2 columns"), std::string::npos);
  EXPECT_NE(complaint("a\n1e999\n").find("is no number"), std::string::npos);
  EXPECT_EQ(complaint(""), "");
  std::filesystem::remove(file);
  EXPECT_THROW(static_cast<void>(load_number_table(file)), ScenarioError);
  EXPECT_TRUE(load_training_record(file, file).progress.rows.empty());
}

}  // namespace
}  // namespace linewright
