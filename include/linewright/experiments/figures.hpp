#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "linewright/experiments/experiment.hpp"
#include "linewright/experiments/table.hpp"
#include "linewright/experiments/training_record.hpp"

// Pictures of results as SVG (charts/chart.hpp).
namespace linewright {

/// The style (chart.hpp) of every row, by name: the same row looks the same in all pictures.
using RowStyles = std::map<std::string, std::size_t>;

/// By first appearance.
[[nodiscard]] RowStyles styles_of(const std::vector<Experiment>& experiments);

/// A picture and the words below it.
struct Figure {
  std::string name;     ///< for a file: letters, digits, '-', '_'
  std::string caption;  ///< plain text
  std::string svg;
  bool wide = false;  ///< as wide as a page; else two have room side by side
};

/// One of the tables: a group of bars per crew with the intervals as whiskers and the paper's
/// figures as diamonds, or lines over the quantities. Of a table of training runs there is none,
/// nor of one in which all numbers are alike.
[[nodiscard]] std::vector<Figure> table_figures(const ExperimentResult& result,
                                                const RowStyles& styles);

/// Curves over the updates, the mean of the seeds in a band from the lowest to the highest: return,
/// makespan and progress of the training episodes, and makespan, progress and success rate of the
/// greedy evaluations; those that were kept. `records`: by row and seed.
[[nodiscard]] std::vector<Figure> training_figures(
    const Experiment& experiment, const std::vector<std::vector<TrainingRecord>>& records,
    const RowStyles& styles);

/// By how many per cent each row is better than the base.
struct Improvements {
  struct Row {
    std::string name;
    std::vector<double> percent;  ///< by axis: shorter, nearer, more often; negative: worse
  };
  std::string base;
  std::vector<std::string> axes;
  std::vector<Row> rows;
};

/// Over all experiments whose `base` is the same row as the first one's, for the rows that all of
/// them have; quantities in which no row differs from the base are left out. Without any axis when
/// no experiment names a base.
[[nodiscard]] Improvements improvements_of(const std::vector<ExperimentResult>& results);

/// As a radar with the base as a ring; with fewer than three axes as bars.
[[nodiscard]] Figure improvement_figure(const Improvements& improvements, const RowStyles& styles);

}  // namespace linewright
