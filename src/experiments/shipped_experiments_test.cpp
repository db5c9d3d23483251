// The experiments that come with Linewright.

#include <gtest/gtest.h>

#include <filesystem>

#include "linewright/experiments/case_study.hpp"
#include "linewright/experiments/experiment.hpp"
#include "linewright/experiments/paper.hpp"

namespace linewright {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> shipped(const std::string& kind) {
  std::vector<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(LINEWRIGHT_SOURCE_DIR "/experiments")) {
    const fs::path& file = entry.path();
    if (file.extension() != ".yaml" || file.filename() == "tables.yaml") continue;
    if (kind_of_study(file.string()) == kind) files.push_back(file.string());
  }
  return files;
}

TEST(ShippedExperiments, AreWellFormed) {
  const std::vector<std::string> files = shipped("");
  EXPECT_GE(files.size(), 15U);
  for (const std::string& file : files) {
    for (const bool quick : {false, true}) {
      const Experiment experiment = load_experiment(file, quick);
      EXPECT_TRUE(fs::exists(experiment.scenario)) << file;
      EXPECT_TRUE(fs::exists(experiment.trained_on)) << file;
      if (quick) {
        EXPECT_EQ(experiment.seeds.size(), 1U) << file;
        EXPECT_LE(experiment.trials, 100U) << file;
      }
    }
  }
}

TEST(ShippedExperiments, NameRowsThatThePaperHas) {
  std::size_t compared = 0;
  for (const std::string& file : shipped("")) {
    const Experiment experiment = load_experiment(file, false);
    if (experiment.paper.empty()) continue;
    const PaperTables paper = load_paper_tables(experiment.paper_tables);
    const auto table = paper.tables.find(experiment.paper);
    ASSERT_NE(table, paper.tables.end()) << file;
    for (const ExperimentRow& row : experiment.rows) {
      if (row.paper.empty()) continue;
      ++compared;
      bool found = false;
      for (const auto& [metric, rows] : table->second.values) found |= rows.count(row.paper) > 0;
      EXPECT_TRUE(found) << file << ": " << row.paper;
    }
  }
  EXPECT_GE(compared, 20U);
}

TEST(ShippedExperiments, HaveACaseStudyAndRoutes) {
  for (const std::string& file : shipped("case_study")) {
    const CaseStudy study = load_case_study(file);
    EXPECT_TRUE(fs::exists(study.scenario));
    EXPECT_EQ(study.marks.size(), 9U);
    for (const CaseRow& row : study.rows) {
      EXPECT_TRUE(row.decisions.empty() || fs::exists(row.decisions));
    }
  }
  EXPECT_EQ(shipped("case_study").size(), 1U);
  ASSERT_EQ(shipped("routes").size(), 1U);
  EXPECT_TRUE(fs::exists(load_route_showcase(shipped("routes")[0]).scenario));
}

}  // namespace
}  // namespace linewright
