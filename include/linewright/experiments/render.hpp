#pragma once

#include <cstddef>
#include <string>

#include "linewright/experiments/table.hpp"

// The tables of an experiment as files. All deterministic and without any local format.
namespace linewright {

/// One line per number: experiment, metric, row, column, mean, ci95, seeds, paper, ratio.
[[nodiscard]] std::string result_csv(const ExperimentResult& result);

/// A section with a table per metric: under each of our rows the paper's and the ratio.
[[nodiscard]] std::string result_markdown(const ExperimentResult& result);

/// `tabular` environments in the style of booktabs, one per metric.
[[nodiscard]] std::string result_latex(const ExperimentResult& result);

/// One of the tables as a picture (SVG): a group of bars per crew with the intervals as whiskers
/// and the paper's figures as diamonds, or lines over the quantities.
[[nodiscard]] std::string result_figure(const ExperimentResult& result, std::size_t table);

/// Everything, for programs.
[[nodiscard]] std::string result_json(const ExperimentResult& result);

}  // namespace linewright
