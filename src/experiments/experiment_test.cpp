#include "linewright/experiments/experiment.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "linewright/base/diagnostic.hpp"
#include "linewright/base/files.hpp"

namespace linewright {
namespace {

constexpr const char* kUsual = R"(title: "A table"
scenario: ../line.yaml
columns: crews
orders: [5]
metrics: [makespan, distance]
seeds: [3, 4]
trials: 7
rows:
  - {row: A, algorithm: ebq-n, paper: EBQ-N}
  - {row: B, planner: "priority:1,2", allocator: no_spatial}
  - {row: C, algorithm: ebq-n, set: [buffer.copies=1, "run.order=3"]}
  - {row: D, bound: combined, trials: 2}
claims:
  - {says: "A walks less", lower: A, than: B, metric: distance}
quick: {seeds: [3], trials: 2}
)";

/// A file of its own for each test.
class ExperimentFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = testing::TempDir() + "/linewright_experiment_" + std::to_string(getpid());
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  Experiment read(const std::string& text, bool quick = false) {
    write_file(file(), text);
    return load_experiment(file(), quick);
  }
  std::string complaint(const std::string& text) {
    try {
      static_cast<void>(read(text));
    } catch (const ScenarioError& error) {
      return error.what();
    }
    return "";
  }
  static std::string with(const std::string& what, const std::string& instead) {
    std::string text = kUsual;
    return text.replace(text.find(what), what.size(), instead);
  }
  [[nodiscard]] std::string file() const { return folder_ + "/tables/one.yaml"; }

  std::string folder_;
};

TEST_F(ExperimentFile, IsRead) {
  const Experiment experiment = read(kUsual);
  EXPECT_EQ(experiment.name, "one");
  EXPECT_EQ(experiment.columns, Experiment::Columns::kCrews);
  EXPECT_EQ(experiment.orders, (std::vector<std::int32_t>{5}));
  EXPECT_EQ(experiment.metrics, (std::vector<Metric>{Metric::kMakespan, Metric::kDistance}));
  EXPECT_EQ(experiment.seeds, (std::vector<std::uint64_t>{3, 4}));
  EXPECT_EQ(experiment.trials, 7U);
  EXPECT_FALSE(experiment.horizon);
  ASSERT_EQ(experiment.rows.size(), 4U);
  EXPECT_EQ(experiment.rows[0].algorithm, "ebq-n");
  EXPECT_EQ(experiment.rows[0].allocator, "sap");
  EXPECT_EQ(experiment.rows[1].planner, "priority:1,2");
  EXPECT_EQ(experiment.rows[2].set, (std::vector<std::string>{"buffer.copies=1", "run.order=3"}));
  EXPECT_EQ(experiment.rows[3].bound, "combined");
  EXPECT_EQ(experiment.rows[3].trials, 2U);
  EXPECT_EQ(experiment.trained_on, experiment.scenario);
  ASSERT_EQ(experiment.claims.size(), 1U);
  EXPECT_EQ(experiment.claims[0].metric, Metric::kDistance);
  EXPECT_EQ(std::filesystem::path(experiment.scenario).lexically_normal(),
            std::filesystem::path(folder_ + "/line.yaml").lexically_normal());
}

TEST_F(ExperimentFile, IsSmallerWhenQuick) {
  const Experiment experiment = read(kUsual, true);
  EXPECT_EQ(experiment.seeds, (std::vector<std::uint64_t>{3}));
  EXPECT_EQ(experiment.trials, 2U);
  EXPECT_EQ(experiment.rows[3].trials, 1U);
}

TEST_F(ExperimentFile, SaysWhatIsWrongAndWhere) {
  const auto says = [&](const std::string& what, const std::string& instead,
                        const std::string& expected) {
    const std::string found = complaint(with(what, instead));
    EXPECT_NE(found.find(expected), std::string::npos) << instead << "\n" << found;
    EXPECT_NE(found.find("one.yaml:"), std::string::npos) << found;
  };
  says("trials: 7", "trails: 7", "did you mean 'trials'?");
  says("trials: 7", "trials: 0", "one.yaml:7");
  says("[makespan, distance]", "[makespam]", "did you mean 'makespan'?");
  says("orders: [5]", "orders: [5, 6]", "a table of crews has one order");
  says("lower: A", "lower: AA", "there is no row 'AA'");
  says("metric: distance", "metric: progress", "does not measure progress");
  says("row: B, planner", "row: A, planner", "two rows 'A'");
  says("planner: \"priority:1,2\"", "paper: B", "either an algorithm or a planner or a bound");
  says("bound: combined", "bound: combind", "did you mean 'combined'?");
  says("algorithm: ebq-n, set", "planner: first, set", "'set' belongs to an algorithm");
  says("trials: 2}\nclaims", "trials: 0}\nclaims", "one.yaml:12");
  says("columns: crews", "columns: crews\nbase: E", "there is no row 'E'");
  says("metric: distance", "metric: distance, column: H1R1", "only claims on training");
  says("columns: crews", "columns: training", "has no 'orders'");
  says("{row: A, algorithm", "{row: A, planner: first, algorithm",
       "either an algorithm or a planner");
}

TEST_F(ExperimentFile, OfTrainingHasColumnsOfItsOwn) {
  const std::string text =
      "title: T\nscenario: line.yaml\ncolumns: training\nrows: [{row: A, algorithm: a}, {row: B, "
      "algorithm: b}]\nclaims: [{says: s, lower: A, than: B, column: minutes}]\n";
  const Experiment experiment = read(text);
  EXPECT_EQ(experiment.metrics, (std::vector<Metric>{Metric::kTraining}));
  EXPECT_EQ(experiment.claims.at(0).metric, Metric::kTraining);
  std::string wrong = text;
  wrong.replace(wrong.find("minutes"), 7, "minuets");
  EXPECT_NE(complaint(wrong).find("did you mean 'minutes'?"), std::string::npos);
  wrong = text;
  wrong.replace(wrong.find("algorithm: b"), 12, "planner: first");
  EXPECT_NE(complaint(wrong).find("row 'B' is not trained"), std::string::npos);
}

TEST_F(ExperimentFile, SaysThatItIsNotThere) {
  EXPECT_THROW(static_cast<void>(load_experiment(folder_ + "/no.yaml", false)), ScenarioError);
}

}  // namespace
}  // namespace linewright
