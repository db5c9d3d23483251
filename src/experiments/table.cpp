#include "linewright/experiments/table.hpp"

#include "judge.hpp"

namespace linewright {
namespace {

using experiments::Sample;

double value_of(const CellResult::Crew& crew, std::size_t trial, Metric metric) {
  switch (metric) {
    case Metric::kMakespan:
      return crew.makespan[trial];
    case Metric::kSuccessRate:
      return crew.finished[trial];
    case Metric::kProgress:
      return crew.progress[trial];
    case Metric::kDistance:
      return crew.distance_m[trial];
    case Metric::kDecisions:
      return crew.decisions[trial];
    case Metric::kTraining:
      break;
  }
  return 0.0;
}

/// By trial: of one crew, or the mean of several; nothing where bounds have no such metric.
std::vector<double> by_trial(const CellResult& cell, std::size_t first_crew, std::size_t crews,
                             Metric metric) {
  if (metric != Metric::kMakespan && cell.crews.at(first_crew).finished.empty()) return {};
  std::vector<double> values(cell.crews.at(first_crew).makespan.size(), 0.0);
  for (std::size_t c = first_crew; c < first_crew + crews; ++c) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] += value_of(cell.crews.at(c), i, metric) / static_cast<double>(crews);
    }
  }
  return values;
}

/// A column is one order and one crew, or all of them.
struct Column {
  std::string name;
  std::size_t order = 0;  ///< index
  std::size_t first_crew = 0;
  std::size_t crews = 1;
  bool is_mean = false;  ///< of the other columns
};

std::vector<Column> columns_of(const Experiment& experiment, const CellResult& sample) {
  std::vector<Column> columns;
  const std::size_t crews = sample.crews.size();
  if (experiment.columns == Experiment::Columns::kOrders) {
    for (std::size_t o = 0; o < experiment.orders.size(); ++o) {
      columns.push_back({std::to_string(experiment.orders[o]), o, 0, crews});
    }
    return columns;
  }
  for (std::size_t c = 0; c < crews; ++c) columns.push_back({sample.crews[c].name, 0, c, 1});
  columns.push_back({"mean", 0, 0, crews, true});
  return columns;
}

/// The mean of each seed.
std::vector<double> seed_means(const RowResults& row, const Column& column, Metric metric) {
  std::vector<double> means;
  for (const std::vector<CellResult>& seed : row) {
    const auto trials = by_trial(seed.at(column.order), column.first_crew, column.crews, metric);
    if (!trials.empty()) means.push_back(spread_of(trials).mean);
  }
  return means;
}

/// One number per training seed where there are several, else one per start.
Sample sample_of(const RowResults& row, const Column& column, Metric metric) {
  if (row.size() > 1) return {spread_of(seed_means(row, column, metric)), Sampled::kSeeds};
  return {spread_of(by_trial(row.at(0).at(column.order), column.first_crew, column.crews, metric)),
          Sampled::kStarts};
}

/// The paper prints no mean over the crews: it is that of its columns.
std::optional<double> paper_value(const PaperTables& paper, const Experiment& experiment,
                                  Metric metric, const std::string& row, const Column& column,
                                  const std::vector<Column>& columns) {
  if (!column.is_mean) return paper.find(experiment.paper, metric, row, column.name);
  double sum = 0.0;
  for (const Column& other : columns) {
    if (other.is_mean) continue;
    const auto value = paper.find(experiment.paper, metric, row, other.name);
    if (!value) return std::nullopt;
    sum += *value;
  }
  return sum / static_cast<double>(columns.size() - 1);
}

/// Over all columns: one number per seed, or per start of a planner that is not trained.
Sample overall(const RowResults& row, const std::vector<Column>& columns, Metric metric) {
  std::vector<double> sum;
  std::size_t counted = 0;
  for (const Column& column : columns) {
    if (column.is_mean) continue;
    ++counted;
    const std::vector<double> values =
        row.size() > 1
            ? seed_means(row, column, metric)
            : by_trial(row.at(0).at(column.order), column.first_crew, column.crews, metric);
    sum.resize(values.size(), 0.0);
    for (std::size_t i = 0; i < values.size(); ++i) sum[i] += values[i];
  }
  for (double& value : sum) value /= static_cast<double>(counted);
  return {spread_of(sum), row.size() > 1 ? Sampled::kSeeds : Sampled::kStarts};
}

}  // namespace

ExperimentResult make_tables(const Experiment& experiment, const std::vector<RowResults>& results,
                             const PaperTables* paper) {
  ExperimentResult result{.experiment = experiment, .tables = {}, .claims = {}};
  const std::vector<Column> columns = columns_of(experiment, results.at(0).at(0).at(0));
  for (const Metric metric : experiment.metrics) {
    ResultTable& table = result.tables.emplace_back(ResultTable{.metric = metric});
    for (const Column& column : columns) table.columns.push_back(column.name);
    for (std::size_t r = 0; r < experiment.rows.size(); ++r) {
      TableRow row{.name = experiment.rows[r].name, .seeds = results.at(r).size()};
      for (const Column& column : columns) {
        const Sample sample = sample_of(results[r], column, metric);
        row.over = sample.over;
        row.samples = sample.spread.count;
        row.values.push_back(experiments::value_of(sample, metric));
        const std::string& theirs = experiment.rows[r].paper;
        if (paper == nullptr || experiment.paper.empty() || theirs.empty()) continue;
        row.values.back().paper = paper_value(*paper, experiment, metric, theirs, column, columns);
      }
      table.rows.push_back(std::move(row));
    }
  }
  for (const Claim& claim : experiment.claims) {
    const auto sample = [&](const std::string& row) {
      return overall(results.at(experiments::row_named(experiment, row)), columns, claim.metric);
    };
    result.claims.push_back(experiments::judged(claim, sample(claim.lower), sample(claim.than)));
  }
  return result;
}

}  // namespace linewright
