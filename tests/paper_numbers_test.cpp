// Figures known of the published line: rules of thumb over the nine crews of the paper.

#include <gtest/gtest.h>

#include "linewright/evaluation/trials.hpp"
#include "tests/support.hpp"

namespace linewright::testing {
namespace {

std::vector<double> means_by_crew(const std::string& scenario, const Configuration& configuration) {
  TrialPlan plan{.crews = {}, .trials = 100, .seed = 1, .threads = 2};
  for (int humans = 1; humans <= 3; ++humans) {
    for (int robots = 1; robots <= 3; ++robots) plan.crews.push_back(crew_of({humans, robots}));
  }
  std::vector<double> means;
  const auto results = run_trials(shipped_line(scenario).scenario, configuration, plan);
  for (std::size_t c = 0; c < results.size(); ++c) {
    const TrialSummary summary = summarize(results[c], plan.crews[c]);
    EXPECT_EQ(summary.success_rate, 1.0);
    means.push_back(summary.makespan.mean);
  }
  return means;
}

double mean(const std::vector<double>& values) { return spread_of(values).mean; }

TEST(PublishedLine, FirstTaskRuleTakes913TicksOnAverage) {
  const auto means = means_by_crew("scenarios/duct_line_published.yaml", {"first", "first_idle"});
  ASSERT_EQ(means.size(), 9U);
  EXPECT_NEAR(mean(means), 913.0, 913.0 * 0.02);
  EXPECT_NEAR(means[0], 1028.0, 1028.0 * 0.02);
}

TEST(PublishedLine, TunedPriorityTakes798TicksOnAverage) {
  const auto means = means_by_crew("scenarios/duct_line_published.yaml",
                                   {"priority:1,2,8,7,3,5,4,9,6", "first_idle"});
  EXPECT_NEAR(mean(means), 798.0, 798.0 * 0.02);
}

TEST(PhysicalLine, FirstTaskRuleTakes918TicksOnAverage) {
  EXPECT_NEAR(mean(means_by_crew("scenarios/duct_line.yaml", {"first", "first_idle"})), 918.0,
              918.0 * 0.02);
}

TEST(PhysicalLine, SpatialAllocationWalksLessThanRandomAndFarthest) {
  const Scenario& scenario = shipped_line("scenarios/duct_line.yaml").scenario;
  const TrialPlan plan{.crews = {crew_of({3, 3})}, .trials = 100, .seed = 1, .threads = 2};
  const auto metres = [&](const char* allocator) {
    return summarize(run_trials(scenario, {"first", allocator}, plan)[0], plan.crews[0])
        .distance_m.mean;
  };
  EXPECT_LT(metres("sap"), metres("no_spatial"));
  EXPECT_LT(metres("no_spatial"), metres("longest_path"));
}

TEST(Trials, DoNotDependOnTheNumberOfThreads) {
  const Scenario& scenario = shipped_line("scenarios/duct_line.yaml").scenario;
  TrialPlan plan{
      .crews = {crew_of({1, 1}), crew_of({2, 3})}, .trials = 50, .seed = 4, .threads = 1};
  const auto one = run_trials(scenario, {"random", "no_spatial"}, plan);
  plan.threads = 4;
  const auto four = run_trials(scenario, {"random", "no_spatial"}, plan);
  ASSERT_EQ(one.size(), four.size());
  for (std::size_t c = 0; c < one.size(); ++c) {
    for (std::size_t t = 0; t < one[c].size(); ++t) {
      EXPECT_EQ(one[c][t].makespan, four[c][t].makespan);
      EXPECT_EQ(one[c][t].distance_mm, four[c][t].distance_mm);
    }
  }
}

TEST(Trials, StartFromTheSamePositionsWhateverTheConfiguration) {
  const Scenario& scenario = shipped_line("scenarios/duct_line.yaml").scenario;
  const TrialPlan plan{.crews = {crew_of({1, 1})}, .trials = 30, .seed = 4, .threads = 2};
  // One human and one robot: all allocators give the same run, so every pair must be equal.
  const auto sap = run_trials(scenario, {"first", "sap"}, plan);
  const auto far = run_trials(scenario, {"first", "longest_path"}, plan);
  EXPECT_EQ(compare_paired(sap[0], far[0]).equal, 30U);
}

TEST(Trials, SharesOfAWorkerAddUpToOne) {
  const Scenario& scenario = shipped_line("scenarios/duct_line.yaml").scenario;
  const TrialPlan plan{.crews = {crew_of({2, 2})}, .trials = 20, .seed = 1, .threads = 2};
  for (const char* planner : {"first", "random"}) {
    const auto results = run_trials(scenario, {planner, "sap"}, plan);
    for (const TrialResult& trial : results[0]) {
      for (const WorkerShares& shares : trial.workers) {
        EXPECT_NEAR(shares.work + shares.travel + shares.wait + shares.idle, 1.0, 1e-12);
        EXPECT_GE(std::min({shares.work, shares.travel, shares.wait, shares.idle}), 0.0);
      }
      for (const double busy : trial.machines) EXPECT_LE(busy, 1.0);
    }
  }
}

}  // namespace
}  // namespace linewright::testing
