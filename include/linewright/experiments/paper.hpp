#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "linewright/experiments/experiment.hpp"

namespace linewright {

/// The figures of the paper, as it prints them, for comparison (experiments/paper/tables.yaml).
struct PaperTables {
  struct Table {
    std::string source;  ///< where in the paper
    std::vector<std::string> columns;
    /// [metric][row]: a value per column
    std::map<Metric, std::map<std::string, std::vector<double>>> values;
  };

  std::string source;
  std::map<std::string, Table> tables;

  /// None where the paper has no such figure.
  [[nodiscard]] std::optional<double> find(const std::string& table, Metric metric,
                                           const std::string& row, const std::string& column) const;
};

/// Throws ScenarioError with everything that is wrong and where it stands.
[[nodiscard]] PaperTables load_paper_tables(const std::string& file);

}  // namespace linewright
