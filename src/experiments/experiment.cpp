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

ExperimentRow read_row(const SourceNode& node, Problems& problems) {
  ExperimentRow row{.name = loading::text_or(node, "row", ""),
                    .algorithm = loading::text_or(node, "algorithm", ""),
                    .planner = loading::text_or(node, "planner", ""),
                    .allocator = loading::text_or(node, "allocator", "sap"),
                    .paper = loading::text_or(node, "paper", "")};
  if (row.algorithm.empty() == row.planner.empty()) {
    problems.error(
        node.mark,
        fmt::format("row {} must have either an algorithm or a planner", in_quotes(row.name)),
        "write algorithm: NAME (it is trained), or planner: NAME");
  }
  return row;
}

std::vector<std::string> row_names(const Experiment& experiment) {
  std::vector<std::string> names;
  for (const ExperimentRow& row : experiment.rows) names.push_back(row.name);
  return names;
}

Claim read_claim(const SourceNode& node, const Experiment& experiment, Problems& problems) {
  Claim claim{.says = loading::text_or(node, "says", ""),
              .lower = loading::text_or(node, "lower", ""),
              .than = loading::text_or(node, "than", ""),
              .metric = metric_of(loading::text_or(node, "metric", "makespan"))};
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

void read_rest(const SourceNode& root, Experiment& experiment, Problems& problems) {
  for (const SourceNode& order : root.find("orders")->items) {
    experiment.orders.push_back(
        static_cast<std::int32_t>(loading::parse_integer(order.text).value_or(1)));
  }
  if (experiment.columns == Experiment::Columns::kCrews && experiment.orders.size() != 1) {
    problems.error(loading::mark_of(root, "orders"), "a table of crews has one order",
                   "write, e.g., orders: [5], or columns: orders");
  }
  for (const SourceNode& metric : root.find("metrics")->items) {
    experiment.metrics.push_back(metric_of(metric.text));
  }
  const SourceNode* horizon = root.find("horizon");
  if (horizon != nullptr && horizon->text != "scenario") {
    experiment.horizon = static_cast<Tick>(loading::parse_integer(horizon->text).value_or(1));
  }
}

}  // namespace

const std::vector<std::string>& metric_names() {
  static const std::vector<std::string> kNames{"makespan", "success_rate", "progress", "distance"};
  return kNames;
}

const std::string& name_of(Metric metric) {
  return metric_names()[static_cast<std::size_t>(metric)];
}

Experiment load_experiment(const std::string& file, bool quick) {
  Problems problems;
  SourceNode root = loading::read_files(file, problems);
  problems.throw_if_any();
  loading::check_shape(root, experiments::experiment_shape(), problems, "the experiment");
  problems.throw_if_any();
  Experiment experiment{
      .name = std::filesystem::path(file).stem().string(),
      .title = loading::text_or(root, "title", ""),
      .about = loading::text_or(root, "about", ""),
      .scenario = beside(file, loading::text_or(root, "scenario", "")),
      .paper = loading::text_or(root, "paper", ""),
      .columns = loading::text_or(root, "columns", "") == "crews" ? Experiment::Columns::kCrews
                                                                  : Experiment::Columns::kOrders,
      .seeds = {1},
      .starts_seed = static_cast<std::uint64_t>(loading::integer_or(root, "starts_seed", 1)),
      .shield = loading::boolean_or(root, "shield", false)};
  read_numbers(root, experiment);
  const SourceNode* reduced = root.find("quick");
  if (quick && reduced != nullptr) read_numbers(*reduced, experiment);
  read_rest(root, experiment, problems);
  read_rows(root, experiment, problems);
  for (ExperimentRow& row : experiment.rows) {
    if (row.algorithm.ends_with(".yaml")) row.algorithm = beside(file, row.algorithm);
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
