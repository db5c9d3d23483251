#include <algorithm>

#include "judge.hpp"
#include "linewright/experiments/table.hpp"

namespace linewright {
namespace {

constexpr double kNearBest = 1.05;

using Records = std::vector<TrainingRecord>;

/// The lowest makespan of all runs, with what is allowed for; none without any evaluation.
std::optional<double> near_best(const std::vector<Records>& records) {
  std::optional<double> best;
  for (const Records& row : records) {
    for (const TrainingRecord& record : row) {
      const auto makespan = record.best_makespan();
      if (makespan) best = std::min(best.value_or(*makespan), *makespan);
    }
  }
  if (best) *best *= kNearBest;
  return best;
}

/// One number of one run.
std::optional<double> number_of(const TrainingRecord& record, const std::string& column,
                                std::optional<double> target) {
  if (column == "minutes") return record.minutes();
  if (column == "best makespan") return record.best_makespan();
  if (column != "updates to 5 %" && column != "minutes to 5 %") return record.last(column);
  if (!target) return std::nullopt;
  // A run that never gets there is counted with its whole length, which favours it.
  const auto updates = record.updates_until(*target);
  if (column == "updates to 5 %") return updates ? updates : record.last("updates");
  return updates ? record.minutes_until(*updates) : record.minutes();
}

/// Over the seeds.
experiments::Sample sample_of(const Records& row, const std::string& column,
                              std::optional<double> target) {
  std::vector<double> numbers;
  for (const TrainingRecord& record : row) {
    if (const auto number = number_of(record, column, target)) numbers.push_back(*number);
  }
  return {spread_of(numbers), Sampled::kSeeds};
}

TableRow row_of(const ExperimentRow& row, const Records& records, std::optional<double> target) {
  TableRow out{.name = row.name, .seeds = records.size(), .over = Sampled::kSeeds};
  for (const std::string& column : training_columns()) {
    const experiments::Sample sample = sample_of(records, column, target);
    out.samples = std::max(out.samples, sample.spread.count);
    out.values.push_back(experiments::value_of(sample, Metric::kTraining));
  }
  return out;
}

}  // namespace

ExperimentResult make_training_table(const Experiment& experiment,
                                     const std::vector<Records>& records,
                                     const PaperTables* paper) {
  ExperimentResult result{.experiment = experiment, .tables = {}, .claims = {}};
  ResultTable& table = result.tables.emplace_back(ResultTable{.metric = Metric::kTraining});
  table.columns = training_columns();
  const auto target = near_best(records);
  for (std::size_t r = 0; r < experiment.rows.size(); ++r) {
    TableRow row = row_of(experiment.rows[r], records.at(r), target);
    const std::string& theirs = experiment.rows[r].paper;
    for (std::size_t c = 0; paper != nullptr && !theirs.empty() && c < row.values.size(); ++c) {
      row.values[c].paper =
          paper->find(experiment.paper, Metric::kTraining, theirs, table.columns[c]);
    }
    table.rows.push_back(std::move(row));
  }
  for (const Claim& claim : experiment.claims) {
    const auto sample = [&](const std::string& row) {
      return sample_of(records.at(experiments::row_named(experiment, row)), claim.column, target);
    };
    result.claims.push_back(experiments::judged(claim, sample(claim.lower), sample(claim.than)));
  }
  return result;
}

}  // namespace linewright
