#include "linewright/experiments/table.hpp"

#include <gtest/gtest.h>

#include "linewright/experiments/figures.hpp"
#include "linewright/experiments/render.hpp"

namespace linewright {
namespace {

/// Two crews with two runs each: their makespans.
CellResult cell(std::vector<Tick> first, std::vector<Tick> second) {
  CellResult result;
  result.crews = {{"H1R1", first, {1, 1}, {1, 1}, {10, 20}, {27, 29}},
                  {"H1R2", second, {1, 0}, {1, 0.5}, {30, 40}, {31, 33}}};
  return result;
}

Experiment two_rows() {
  Experiment experiment{.name = "test", .title = "Test", .paper = "table"};
  experiment.orders = {5};
  experiment.metrics = {Metric::kMakespan, Metric::kSuccessRate};
  experiment.rows = {{.name = "A", .algorithm = "a", .paper = "A"}, {.name = "B", .planner = "b"}};
  experiment.claims = {{.says = "A is faster", .lower = "A", .than = "B"}};
  experiment.seeds = {1, 2};
  experiment.trials = 2;
  return experiment;
}

/// A: two seeds. B: one.
std::vector<RowResults> results() {
  return {{{cell({100, 110}, {200, 220})}, {cell({104, 114}, {200, 220})}},
          {{cell({300, 310}, {400, 420})}}};
}

TEST(ResultTable, HasMeansAndIntervalsOverSeedsOrStarts) {
  const ExperimentResult result = make_tables(two_rows(), results());
  ASSERT_EQ(result.tables.size(), 2U);
  const ResultTable& makespan = result.tables[0];
  EXPECT_EQ(makespan.columns, (std::vector<std::string>{"H1R1", "H1R2", "mean"}));
  const TableRow& a = makespan.rows[0];
  EXPECT_EQ(a.seeds, 2U);
  EXPECT_DOUBLE_EQ(*a.values[0].mean, 107.0);
  // Seeds 105 and 109: sd 2.828, t of one degree 12.706.
  EXPECT_NEAR(*a.values[0].ci95, 12.706 * 2.8284271 / 1.4142136, 1e-2);
  EXPECT_DOUBLE_EQ(*a.values[2].mean, (107.0 + 210.0) / 2);
  const TableRow& b = makespan.rows[1];
  EXPECT_DOUBLE_EQ(*b.values[2].mean, (305.0 + 410.0) / 2);
  // Starts: (300 + 400) / 2 and (310 + 420) / 2.
  EXPECT_NEAR(*b.values[2].ci95, 12.706 * 10.6066 / 1.4142136, 1e-1);
  EXPECT_DOUBLE_EQ(*result.tables[1].rows[0].values[1].mean, 0.5);
}

TEST(ResultTable, MeasuresDistanceAndDecisions) {
  Experiment experiment = two_rows();
  experiment.metrics = {Metric::kDistance, Metric::kDecisions};
  const ExperimentResult result = make_tables(experiment, results());
  EXPECT_DOUBLE_EQ(*result.tables[0].rows[0].values[0].mean, 15.0);
  EXPECT_DOUBLE_EQ(*result.tables[1].rows[0].values[0].mean, 28.0);
  EXPECT_DOUBLE_EQ(*result.tables[1].rows[0].values[2].mean, 30.0);
}

TEST(ResultTable, PutsThePaperBeside) {
  PaperTables paper;
  paper.tables["table"] = {.columns = {"H1R1", "H1R2"}};
  paper.tables["table"].values[Metric::kMakespan]["A"] = {214.0, 100.0};
  const ExperimentResult result = make_tables(two_rows(), results(), &paper);
  const TableRow& a = result.tables[0].rows[0];
  EXPECT_DOUBLE_EQ(*a.values[0].paper, 214.0);
  EXPECT_DOUBLE_EQ(*a.values[0].ratio(), 0.5);
  EXPECT_DOUBLE_EQ(*a.values[2].paper, 157.0);  // the mean of its columns
  EXPECT_FALSE(result.tables[0].rows[1].values[0].paper);
  EXPECT_FALSE(result.tables[1].rows[0].values[0].paper);  // it has no success rates
}

TEST(ResultTable, HasAColumnPerOrder) {
  Experiment experiment = two_rows();
  experiment.columns = Experiment::Columns::kOrders;
  experiment.orders = {1, 2};
  std::vector<RowResults> rows = results();
  for (RowResults& row : rows) {
    for (auto& seed : row) seed.push_back(cell({1, 1}, {3, 3}));
  }
  const ExperimentResult result = make_tables(experiment, rows);
  EXPECT_EQ(result.tables[0].columns, (std::vector<std::string>{"1", "2"}));
  EXPECT_DOUBLE_EQ(*result.tables[0].rows[1].values[1].mean, 2.0);
}

/// Of a bound there are makespans only.
CellResult bound_cell() {
  CellResult result;
  result.crews = {{.name = "H1R1", .makespan = {90}}, {.name = "H1R2", .makespan = {180}}};
  return result;
}

TEST(ResultTable, HasOnlyMakespansOfABound) {
  Experiment experiment = two_rows();
  experiment.rows[1] = {.name = "bound", .bound = "combined"};
  experiment.claims.clear();
  const ExperimentResult result = make_tables(experiment, {results()[0], {{bound_cell()}}});
  const TableRow& bound = result.tables[0].rows[1];
  EXPECT_DOUBLE_EQ(*bound.values[2].mean, 135.0);
  EXPECT_FALSE(bound.values[2].ci95);  // one start
  for (const TableValue& value : result.tables[1].rows[1].values) EXPECT_FALSE(value.mean);
  EXPECT_NE(result_csv(result).find("test,success_rate,bound,mean,,,,,starts,0,1,,\n"),
            std::string::npos)
      << result_csv(result);
}

TEST(ResultTable, KeepsIntervalsOfSharesWithinZeroAndOne) {
  std::vector<RowResults> rows = results();
  for (CellResult::Crew& crew : rows[0][1][0].crews) crew.finished = {1, 1};
  const TableValue value = make_tables(two_rows(), rows).tables[1].rows[0].values[1];
  EXPECT_DOUBLE_EQ(*value.mean, 0.75);  // of 0.5 and 1
  EXPECT_DOUBLE_EQ(*value.high, 1.0);
  EXPECT_DOUBLE_EQ(*value.low, 0.0);
  EXPECT_GT(*value.ci95, 1.0);
  const std::string markdown = result_markdown(make_tables(two_rows(), rows));
  EXPECT_NE(markdown.find("0.750 (0.000 to 1.000)"), std::string::npos) << markdown;
  EXPECT_EQ(markdown.find("± 0.000"), std::string::npos) << markdown;
}

TEST(Claim, IsJudgedByTheIntervalOfTheDifference) {
  const auto verdict = [](std::vector<RowResults> rows) {
    return make_tables(two_rows(), rows).claims.at(0).verdict;
  };
  using Verdict = JudgedClaim::Verdict;
  const auto seeds = [](std::vector<Tick> makespans) {
    RowResults row;
    for (const Tick makespan : makespans) {
      row.push_back({cell({makespan, makespan}, {makespan, makespan})});
    }
    return row;
  };
  EXPECT_EQ(verdict({seeds({100, 101, 102}), seeds({200, 201, 202})}), Verdict::kHolds);
  EXPECT_EQ(verdict({seeds({200, 201, 202}), seeds({100, 101, 102})}), Verdict::kContrary);
  EXPECT_EQ(verdict({seeds({100, 150, 200}), seeds({110, 160, 210})}), Verdict::kOpen);
  const JudgedClaim claim =
      make_tables(two_rows(), {seeds({100, 101, 102}), seeds({200, 201, 202})}).claims[0];
  EXPECT_DOUBLE_EQ(claim.difference.mean, -100.0);
}

TEST(Render, WritesTheSameNumbersEverywhere) {
  PaperTables paper;
  paper.tables["table"] = {.columns = {"H1R1", "H1R2"}};
  paper.tables["table"].values[Metric::kMakespan]["A"] = {214.0, 100.0};
  Experiment experiment = two_rows();
  experiment.rows[1].name = "B, \"the | other\"";
  experiment.claims[0].than = experiment.rows[1].name;
  const ExperimentResult result = make_tables(experiment, results(), &paper);
  const std::string csv = result_csv(result);
  EXPECT_EQ(csv.substr(0, csv.find('\n')),
            "experiment,metric,row,column,mean,ci95,low,high,over,samples,seeds,paper,ratio");
  EXPECT_NE(csv.find("test,makespan,A,H1R1,107,25.4124,81.5876,132.412,seeds,2,2,214,0.5\n"),
            std::string::npos)
      << csv;
  EXPECT_NE(csv.find("\"B, \"\"the | other\"\"\",mean,357.5"), std::string::npos) << csv;
  const std::string markdown = result_markdown(result);
  EXPECT_NE(markdown.find("| **A** | 107.0 ± 25.4 |"), std::string::npos) << markdown;
  EXPECT_NE(markdown.find("| ratio | 0.500 | 2.100 | 1.010 |"), std::string::npos) << markdown;
  EXPECT_NE(markdown.find("| paper | 214.0 | 100.0 | 157.0 |"), std::string::npos) << markdown;
  EXPECT_NE(markdown.find("the \\| other"), std::string::npos);
  EXPECT_NE(markdown.find("| A is faster | -199.00 |"), std::string::npos) << markdown;
  EXPECT_NE(markdown.find("| over seeds and starts | holds |"), std::string::npos) << markdown;
  EXPECT_NE(result_latex(result).find("107.0\\,$\\pm$\\,25.4"), std::string::npos);
  const std::vector<Figure> figures = table_figures(result, styles_of({experiment}));
  ASSERT_EQ(figures.size(), 2U);
  EXPECT_NE(figures[0].svg.find("H1R2"), std::string::npos);
  EXPECT_NE(result_json(result).find("\"verdict\": "), std::string::npos);
}

}  // namespace
}  // namespace linewright
