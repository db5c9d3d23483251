#include "row_styles.hpp"

#include <algorithm>

#include "linewright/charts/chart.hpp"

namespace linewright {

RowStyles styles_of(const std::vector<Experiment>& experiments) {
  RowStyles styles;
  for (const Experiment& experiment : experiments) {
    for (const ExperimentRow& row : experiment.rows) styles.emplace(row.name, styles.size());
  }
  return styles;
}

namespace experiments {

std::vector<std::size_t> styles_for(const std::vector<std::string>& rows, const RowStyles& book) {
  std::vector<std::size_t> styles;
  for (const std::string& row : rows) {
    const auto found = book.find(row);
    std::size_t style = (found == book.end() ? styles.size() : found->second) % kChartStyles;
    for (std::size_t tried = 0; tried < kChartStyles; ++tried) {
      if (std::find(styles.begin(), styles.end(), style) == styles.end()) break;
      style = (style + 1) % kChartStyles;
    }
    styles.push_back(style);
  }
  return styles;
}

}  // namespace experiments
}  // namespace linewright
