#pragma once

#include <cstddef>
#include <string>

#include "linewright/experiments/table.hpp"

// The tables of an experiment as files. All deterministic and without any local format.
namespace linewright {

/// One line per number: experiment, metric, row, column, mean, ci95, low, high, over, samples,
/// seeds, paper, ratio.
[[nodiscard]] std::string result_csv(const ExperimentResult& result);

/// A section with a table per metric: under each of our rows the paper's and the ratio.
[[nodiscard]] std::string result_markdown(const ExperimentResult& result);

/// `tabular` environments in the style of booktabs, one per metric.
[[nodiscard]] std::string result_latex(const ExperimentResult& result);

/// Everything, for programs.
[[nodiscard]] std::string result_json(const ExperimentResult& result);

}  // namespace linewright
