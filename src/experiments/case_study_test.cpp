#include "linewright/experiments/case_study.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "linewright/base/diagnostic.hpp"
#include "linewright/base/files.hpp"
#include "linewright/scenario/load.hpp"

namespace linewright {
namespace {

constexpr const char* kStudy = R"(kind: case_study
title: A case
scenario: duct_line.yaml
order: 2
starts: {human: [rest_east, storage], robot: [flange_rack, cage_bay_1], cage: [storage, flange_table]}
rows:
  - {row: list, planner: "priority:tuned"}
  - {row: lowest, planner: first}
marks:
  - {mark: a, task: bring_flanges, says: first}
  - {mark: b, task: cut_straight, nth: 2}
  - {mark: z, task: cut_straight, nth: 99}
)";

const Scenario& duct_line() {
  static const Scenario kScenario =
      load_scenario(LINEWRIGHT_SOURCE_DIR "/scenarios/duct_line.yaml");
  return kScenario;
}

class CaseFile : public testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove_all(folder_); }

  CaseStudy read(const std::string& text) {
    write_file(folder_ + "/case.yaml", text);
    return load_case_study(folder_ + "/case.yaml");
  }
  static std::string with(const std::string& what, const std::string& instead) {
    std::string text = kStudy;
    return text.replace(text.find(what), what.size(), instead);
  }
  /// What is wrong with the file, or with playing its first row.
  std::string complaint(const std::string& text) {
    try {
      const CaseStudy study = read(text);
      static_cast<void>(play_case(study, study.rows[0], study.rows[0].who.planner, duct_line()));
    } catch (const ScenarioError& error) {
      return error.what();
    }
    return "";
  }

  std::string folder_ = testing::TempDir() + "/linewright_case_" + std::to_string(getpid());
};

TEST_F(CaseFile, IsReadAndPlayedFromItsStarts) {
  const CaseStudy study = read(kStudy);
  EXPECT_EQ(kind_of_study(folder_ + "/case.yaml"), "case_study");
  std::vector<LogDocument> logs;
  for (const CaseRow& row : study.rows) {
    logs.push_back(play_case(study, row, row.who.planner, duct_line()));
  }
  const LogHeader& header = logs[0].header;
  EXPECT_EQ(header.quantity, 2);
  ASSERT_EQ(header.workers.size(), 4U);
  EXPECT_EQ(header.stations[header.workers[1].start.index()].name, "storage");
  EXPECT_EQ(header.stations[header.workers[3].start.index()].name, "cage_bay_1");
  EXPECT_EQ(header.carriers.size(), 2U);
  EXPECT_TRUE(logs[0].end.makespan);

  const ReportSection section = section_of(study, logs);
  ASSERT_EQ(section.tables.size(), 2U);
  EXPECT_EQ(section.tables[0].rows[0].cells[1], std::to_string(*logs[0].end.makespan));
  EXPECT_EQ(section.tables[1].rows[0].cells,
            (std::vector<std::string>{"a", "bring_flanges", "1", "1", "1", "first"}));
  EXPECT_EQ(section.tables[1].rows[2].cells[3], "never");
  ASSERT_EQ(section.figures.size(), 4U);  // two charts, and the hall at a and b
  EXPECT_EQ(section.figures[2].figure.name, "case_snapshot_a");
  EXPECT_NE(section.figures[3].figure.svg.find("class=\"worker"), std::string::npos);
  for (std::size_t row = 0; row < 2; ++row) {
    EXPECT_NE(section.figures[row].figure.svg.find(">b</text>"), std::string::npos);
    EXPECT_EQ(section.figures[row].figure.svg.find(">z</text>"), std::string::npos);
  }
}

TEST_F(CaseFile, SaysWhatIsWrong) {
  EXPECT_EQ(complaint(kStudy), "");
  EXPECT_NE(complaint(with("order: 2", "ordre: 2")).find("did you mean 'order'?"),
            std::string::npos);
  EXPECT_NE(complaint(with("rest_east", "rest_est")).find("did you mean 'rest_east'?"),
            std::string::npos);
  EXPECT_NE(complaint(with("robot: [", "robots: [")).find("did you mean 'robot'?"),
            std::string::npos);
  EXPECT_NE(complaint(with("planner: first", "seed: 1")).find("case.yaml:8"), std::string::npos);
  EXPECT_NE(complaint(with("[rest_east, storage]", "[storage, storage, storage, storage]"))
                .find("4 starts of 'human', but the line has 1 to 3"),
            std::string::npos);
  EXPECT_NE(complaint(with("robot: [flange_rack, cage_bay_1], ", "")).find("0 starts of 'robot'"),
            std::string::npos);
}

TEST_F(CaseFile, ReplaysRecordedDecisions) {
  const std::string record = LINEWRIGHT_SOURCE_DIR "/experiments/paper/published_ebq_n.json";
  CaseStudy study = read(with("planner: \"priority:tuned\"", "decisions: " + record));
  study.order = 5;
  const LogDocument log = play_case(study, study.rows[0], "", duct_line());
  EXPECT_EQ(log.decisions.size(), 29U);
  EXPECT_EQ(log.header.tasks[log.decision(1).task.index()].name, "bring_flanges");
}

TEST_F(CaseFile, OfRoutesNeedsRoutes) {
  write_file(folder_ + "/routes.yaml", "kind: routes\ntitle: R\nscenario: line.yaml\n");
  EXPECT_EQ(kind_of_study(folder_ + "/routes.yaml"), "routes");
  const RouteShowcase showcase = load_route_showcase(folder_ + "/routes.yaml");
  EXPECT_THROW(static_cast<void>(section_of(showcase, duct_line())), ScenarioError);
  EXPECT_EQ(kind_of_study(folder_ + "/none.yaml"), "");
}

}  // namespace
}  // namespace linewright
