#include "linewright/experiments/paper.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "linewright/scenario/shape_check.hpp"
#include "linewright/scenario/shape_makers.hpp"
#include "linewright/scenario/source_files.hpp"
#include "linewright/scenario/values.hpp"

namespace linewright {
namespace {

using loading::Problems;
using loading::ShapePtr;
using loading::SourceEntry;
using loading::SourceNode;
using Kind = loading::Shape::Kind;

const loading::Shape& paper_shape() {
  constexpr double kLargest = 1e9;
  static const loading::Shape kShape = [] {
    const ShapePtr text = loading::scalar(Kind::kText, "a text");
    const ShapePtr name = loading::scalar(Kind::kName, "a name");
    const ShapePtr rows = loading::names_to(
        loading::list(loading::real(0.0, kLargest), "a list of numbers", 1), "a mapping of rows");
    std::vector<loading::Field> fields{
        loading::required("source", text, ""),
        loading::required("columns", loading::list(name, "a list of columns", 1), "")};
    for (const std::string& metric : metric_names()) {
      fields.push_back(loading::key(metric, rows, ""));
    }
    const ShapePtr table = loading::mapping("a table", std::move(fields));
    return *loading::mapping(
        "a mapping", {loading::required("source", text, ""),
                      loading::required(
                          "tables", loading::names_to(table, "a mapping of tables", "table"), "")});
  }();
  return kShape;
}

PaperTables::Table read_table(const SourceNode& node, Problems& problems) {
  PaperTables::Table table{.source = loading::text_or(node, "source", "")};
  for (const SourceNode& column : node.find("columns")->items) {
    table.columns.push_back(column.text);
  }
  for (std::size_t m = 0; m < metric_names().size(); ++m) {
    const SourceNode* rows = node.find(metric_names()[m]);
    if (rows == nullptr) continue;
    for (const SourceEntry& row : rows->entries) {
      std::vector<double>& values = table.values[static_cast<Metric>(m)][row.key];
      for (const SourceNode& value : row.value.items) {
        values.push_back(loading::parse_real(value.text).value_or(0.0));
      }
      if (values.size() == table.columns.size()) continue;
      problems.error(row.mark,
                     fmt::format("row {} has {} values for {} columns", in_quotes(row.key),
                                 values.size(), table.columns.size()),
                     "write one value per column");
    }
  }
  return table;
}

}  // namespace

std::optional<double> PaperTables::find(const std::string& table, Metric metric,
                                        const std::string& row, const std::string& column) const {
  const auto found = tables.find(table);
  if (found == tables.end()) return std::nullopt;
  const auto& columns = found->second.columns;
  const auto at = std::find(columns.begin(), columns.end(), column);
  const auto of_metric = found->second.values.find(metric);
  if (at == columns.end() || of_metric == found->second.values.end()) return std::nullopt;
  const auto values = of_metric->second.find(row);
  if (values == of_metric->second.end()) return std::nullopt;
  return values->second[static_cast<std::size_t>(at - columns.begin())];
}

PaperTables load_paper_tables(const std::string& file) {
  Problems problems;
  SourceNode root = loading::read_files(file, problems);
  problems.throw_if_any();
  loading::check_shape(root, paper_shape(), problems, "the file of the paper's tables");
  problems.throw_if_any();
  PaperTables paper{.source = loading::text_or(root, "source", "")};
  for (const SourceEntry& entry : root.find("tables")->entries) {
    paper.tables.emplace(entry.key, read_table(entry.value, problems));
  }
  problems.throw_if_any();
  return paper;
}

}  // namespace linewright
