#include <fmt/format.h>

#include "linewright/experiments/report.hpp"
#include "metric_titles.hpp"
#include "number_text.hpp"

namespace linewright {
namespace {

using Row = ReportTable::Row;

void add_rows(const TableRow& row, Metric metric, ReportTable& table) {
  Row ours{.cells = {row.name}};
  Row paper{.cells = {"paper"}, .secondary = true};
  Row ratio{.cells = {"ours / paper"}, .secondary = true};
  for (const TableValue& value : row.values) {
    ours.cells.push_back(experiments::value_text(value, metric));
    paper.cells.push_back(experiments::paper_text(value, metric));
    ratio.cells.push_back(experiments::ratio_text(value));
  }
  ours.cells.push_back(experiments::samples_text(row));
  paper.cells.emplace_back();
  ratio.cells.emplace_back();
  table.rows.push_back(std::move(ours));
  if (!row.has_paper()) return;
  table.rows.push_back(std::move(paper));
  table.rows.push_back(std::move(ratio));
}

bool has_numbers(const TableRow& row) {
  for (const TableValue& value : row.values) {
    if (value.mean || value.paper) return true;
  }
  return false;
}

ReportTable table_of(const ResultTable& result) {
  ReportTable table{.caption = experiments::title_of(result.metric), .header = {""}};
  table.header.insert(table.header.end(), result.columns.begin(), result.columns.end());
  table.header.emplace_back("mean of");
  for (const TableRow& row : result.rows) {
    if (has_numbers(row)) add_rows(row, result.metric, table);
  }
  return table;
}

ReportTable claims_of(const ExperimentResult& result) {
  ReportTable table{.caption =
                        "Claims, judged by these runs: the difference of the "
                        "means over all columns with its 95 % interval (Welch)",
                    .header = {"claim", "difference", "95 %", "interval", "verdict"}};
  for (const JudgedClaim& judged : result.claims) {
    std::string what = name_of(judged.claim.metric);
    if (!judged.claim.column.empty()) what = judged.claim.column;
    table.rows.push_back(
        {.cells = {fmt::format("{} ({})", judged.claim.says, what),
                   fmt::format("{:+.2f}", judged.difference.mean),
                   judged.difference.ci95 > 0.0 ? fmt::format("± {:.2f}", judged.difference.ci95)
                                                : "none: one run only",
                   experiments::over_text(judged), name_of(judged.verdict)}});
  }
  return table;
}

}  // namespace

ReportSection section_of(const ExperimentResult& result, std::vector<Figure> figures) {
  const Experiment& experiment = result.experiment;
  ReportSection section{.title = experiment.title};
  if (!experiment.about.empty()) section.paragraphs.push_back(experiment.about);
  section.paragraphs.push_back(experiments::what_was_run(experiment));
  for (const ResultTable& table : result.tables) section.tables.push_back(table_of(table));
  if (!result.claims.empty()) section.tables.push_back(claims_of(result));
  for (Figure& figure : figures) section.figures.push_back({.figure = std::move(figure)});
  return section;
}

ReportSection section_of(const Improvements& improvements, const RowStyles& styles) {
  ReportSection section{.title = fmt::format("Improvement over {}", improvements.base)};
  section.paragraphs.emplace_back(
      "Differences of means without intervals: which of them are certain is said by the claims of "
      "the tables above. Quantities in which no row differs are left out.");
  ReportTable table{.caption = "Per cent better than " + improvements.base, .header = {""}};
  table.header.insert(table.header.end(), improvements.axes.begin(), improvements.axes.end());
  for (const Improvements::Row& row : improvements.rows) {
    Row& out = table.rows.emplace_back(Row{.cells = {row.name}});
    for (const double percent : row.percent) out.cells.push_back(fmt::format("{:+.1f}", percent));
  }
  section.tables.push_back(std::move(table));
  section.figures.push_back({.figure = improvement_figure(improvements, styles)});
  return section;
}

}  // namespace linewright
