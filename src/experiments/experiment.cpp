#include "linewright/experiments/experiment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "experiment_shape.hpp"
#include "linewright/base/files.hpp"
#include "linewright/scenario/shape_check.hpp"
#include "linewright/scenario/source_files.hpp"
#include "linewright/scenario/values.hpp"

namespace linewright {
namespace {

using loading::Problems;
using loading::SourceNode;

Metric metric_of(const std::string& name) {
  const auto& names = metric_names();
  return static_cast<Metric>(std::find(names.begin(), names.end(), name) - names.begin());
}

std::vector<std::string> texts(const SourceNode& node, const char* key) {
  std::vector<std::string> texts;
  const SourceNode* list = node.find(key);
  if (list == nullptr) return texts;
  for (const SourceNode& item : list->items) texts.push_back(item.text);
  return texts;
}

void check_row(const ExperimentRow& row, const SourceNode& node, Problems& problems) {
  const auto name = in_quotes(row.name);
  const int ways = static_cast<int>(!row.algorithm.empty()) +
                   static_cast<int>(!row.planner.empty()) + static_cast<int>(!row.bound.empty());
  if (ways != 1) {
    problems.error(
        node.mark,
        fmt::format("row {} must have either an algorithm or a planner or a bound", name),
        "write algorithm: NAME (it is trained), planner: NAME, or bound: combined");
  }
  if (!row.set.empty() && row.algorithm.empty()) {
    problems.error(loading::mark_of(node, "set"), fmt::format("row {} is not trained", name),
                   "'set' belongs to an algorithm");
  }
}

ExperimentRow read_row(const SourceNode& node, Problems& problems) {
  ExperimentRow row{.name = loading::text_or(node, "row", ""),
                    .algorithm = loading::text_or(node, "algorithm", ""),
                    .set = texts(node, "set"),
                    .planner = loading::text_or(node, "planner", ""),
                    .bound = loading::text_or(node, "bound", ""),
                    .allocator = loading::text_or(node, "allocator", "sap"),
                    .paper = loading::text_or(node, "paper", ""),
                    .trials = {}};
  if (node.find("trials") != nullptr) {
    row.trials = static_cast<std::size_t>(loading::integer_or(node, "trials", 1));
  }
  check_row(row, node, problems);
  return row;
}

std::vector<std::string> row_names(const Experiment& experiment) {
  std::vector<std::string> names;
  for (const ExperimentRow& row : experiment.rows) names.push_back(row.name);
  return names;
}

Claim read_claim(const SourceNode& node, const Experiment& experiment, Problems& problems) {
  const bool training = experiment.columns == Experiment::Columns::kTraining;
  const char* usual = training ? "training" : "makespan";
  Claim claim{.says = loading::text_or(node, "says", ""),
              .lower = loading::text_or(node, "lower", ""),
              .than = loading::text_or(node, "than", ""),
              .metric = metric_of(loading::text_or(node, "metric", usual)),
              .column = loading::text_or(node, "column", "")};
  const std::vector<std::string> names = row_names(experiment);
  for (const auto& [key, row] : {std::pair{"lower", claim.lower}, {"than", claim.than}}) {
    if (std::find(names.begin(), names.end(), row) != names.end()) continue;
    problems.error(loading::mark_of(node, key), fmt::format("there is no row {}", in_quotes(row)),
                   problems.hint(row, names));
  }
  if (std::find(experiment.metrics.begin(), experiment.metrics.end(), claim.metric) ==
      experiment.metrics.end()) {
    problems.error(loading::mark_of(node, "metric"),
                   fmt::format("the experiment does not measure {}", name_of(claim.metric)),
                   "add it to 'metrics'");
  }
  if (!training && !claim.column.empty()) {
    problems.error(loading::mark_of(node, "column"), "only claims on training name a column",
                   "leave it out: the mean of all columns is compared");
  }
  const std::vector<std::string>& columns = training_columns();
  if (training && std::find(columns.begin(), columns.end(), claim.column) == columns.end()) {
    problems.error(loading::mark_of(node, "column"),
                   "a claim on training must name one of its columns",
                   problems.hint(claim.column, columns));
  }
  return claim;
}

void read_rows(const SourceNode& root, Experiment& experiment, Problems& problems) {
  for (const SourceNode& node : root.find("rows")->items) {
    experiment.rows.push_back(read_row(node, problems));
    const std::vector<std::string> names = row_names(experiment);
    if (std::count(names.begin(), names.end(), names.back()) > 1) {
      problems.error(node.mark, fmt::format("there are two rows {}", in_quotes(names.back())),
                     "give each a name of its own");
    }
  }
}

void read_numbers(const SourceNode& root, Experiment& experiment) {
  if (const SourceNode* seeds = root.find("seeds")) {
    experiment.seeds.clear();
    for (const SourceNode& seed : seeds->items) {
      experiment.seeds.push_back(
          static_cast<std::uint64_t>(loading::parse_integer(seed.text).value_or(1)));
    }
  }
  experiment.trials = static_cast<std::size_t>(
      loading::integer_or(root, "trials", static_cast<std::int32_t>(experiment.trials)));
}

/// What is played, and what is measured of it.
void read_columns(const SourceNode& root, Experiment& experiment, Problems& problems) {
  const std::string columns = loading::text_or(root, "columns", "");
  if (columns == "training") {
    experiment.columns = Experiment::Columns::kTraining;
    experiment.metrics = {Metric::kTraining};
    for (const char* key : {"orders", "metrics"}) {
      if (root.find(key) == nullptr) continue;
      problems.error(loading::mark_of(root, key),
                     fmt::format("a table of training runs has no {}", in_quotes(key)),
                     "leave it out: its columns are given");
    }
    return;
  }
  experiment.columns =
      columns == "crews" ? Experiment::Columns::kCrews : Experiment::Columns::kOrders;
  for (const std::string& order : texts(root, "orders")) {
    experiment.orders.push_back(
        static_cast<std::int32_t>(loading::parse_integer(order).value_or(1)));
  }
  for (const std::string& metric : texts(root, "metrics")) {
    experiment.metrics.push_back(metric_of(metric));
  }
  if (experiment.columns == Experiment::Columns::kCrews && experiment.orders.size() != 1) {
    problems.error(loading::mark_of(root, "orders"), "a table of crews has one order",
                   "write, e.g., orders: [5], or columns: orders");
  } else if (experiment.orders.empty()) {
    problems.error(root.mark, "the key 'orders' is missing", "write, e.g., orders: [1, 2, 5]");
  }
  if (experiment.metrics.empty()) {
    problems.error(root.mark, "the key 'metrics' is missing", "write, e.g., metrics: [makespan]");
  }
  const SourceNode* horizon = root.find("horizon");
  if (horizon != nullptr && horizon->text != "scenario") {
    experiment.horizon = static_cast<Tick>(loading::parse_integer(horizon->text).value_or(1));
  }
}

void check_rows(const SourceNode& root, const Experiment& experiment, Problems& problems) {
  const std::vector<std::string> names = row_names(experiment);
  if (!experiment.base.empty() &&
      std::find(names.begin(), names.end(), experiment.base) == names.end()) {
    problems.error(loading::mark_of(root, "base"),
                   fmt::format("there is no row {}", in_quotes(experiment.base)),
                   problems.hint(experiment.base, names));
  }
  if (experiment.columns != Experiment::Columns::kTraining) return;
  for (std::size_t r = 0; r < experiment.rows.size(); ++r) {
    if (!experiment.rows[r].algorithm.empty()) continue;
    problems.error(root.find("rows")->items[r].mark,
                   fmt::format("row {} is not trained", in_quotes(experiment.rows[r].name)),
                   "a table of training runs has rows with an algorithm only");
  }
}

}  // namespace

const std::vector<std::string>& metric_names() {
  static const std::vector<std::string> kNames{"makespan", "success_rate", "progress",
                                               "distance", "decisions",    "training"};
  return kNames;
}

const std::string& name_of(Metric metric) {
  return metric_names()[static_cast<std::size_t>(metric)];
}

const std::vector<std::string>& training_columns() {
  static const std::vector<std::string> kNames{"minutes",       "updates",       "episodes",
                                               "decisions",     "best makespan", "updates to 5 %",
                                               "minutes to 5 %"};
  return kNames;
}

Experiment load_experiment(const std::string& file, bool quick) {
  Problems problems;
  SourceNode root = loading::read_files(file, problems);
  problems.throw_if_any();
  loading::check_shape(root, experiments::experiment_shape(), problems, "the experiment");
  problems.throw_if_any();
  const std::string scenario = loading::text_or(root, "scenario", "");
  Experiment experiment{
      .name = std::filesystem::path(file).stem().string(),
      .title = loading::text_or(root, "title", ""),
      .about = loading::text_or(root, "about", ""),
      .scenario = beside(file, scenario),
      .trained_on = beside(file, loading::text_or(root, "trained_on", scenario)),
      .paper = loading::text_or(root, "paper", ""),
      .paper_tables = beside(file, loading::text_or(root, "paper_tables", "tables.yaml")),
      .base = loading::text_or(root, "base", ""),
      .seeds = {1},
      .starts_seed = static_cast<std::uint64_t>(loading::integer_or(root, "starts_seed", 1)),
      .shield = loading::boolean_or(root, "shield", false)};
  read_numbers(root, experiment);
  const SourceNode* reduced = root.find("quick");
  if (quick && reduced != nullptr) read_numbers(*reduced, experiment);
  read_columns(root, experiment, problems);
  read_rows(root, experiment, problems);
  check_rows(root, experiment, problems);
  for (ExperimentRow& row : experiment.rows) {
    if (row.algorithm.ends_with(".yaml")) row.algorithm = beside(file, row.algorithm);
    if (quick && row.trials) row.trials = 1;  // such rows take long
  }
  if (const SourceNode* claims = root.find("claims")) {
    for (const SourceNode& node : claims->items) {
      experiment.claims.push_back(read_claim(node, experiment, problems));
    }
  }
  problems.throw_if_any();
  return experiment;
}

}  // namespace linewright
