#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "linewright/charts/bar_chart.hpp"
#include "linewright/charts/line_chart.hpp"
#include "linewright/experiments/figures.hpp"
#include "metric_titles.hpp"
#include "row_styles.hpp"

namespace linewright {
namespace {

using experiments::title_of;

constexpr double kWide = 1200.0;  ///< a dozen rows by nine crews
constexpr double kHigh = 460.0;
constexpr double kLineHigh = 520.0;
constexpr double kVisible = 0.001;

/// The rows that have this metric at all.
std::vector<const TableRow*> rows_with_numbers(const ResultTable& table) {
  std::vector<const TableRow*> rows;
  for (const TableRow& row : table.rows) {
    if (std::any_of(row.values.begin(), row.values.end(),
                    [](const TableValue& value) { return value.mean.has_value(); })) {
      rows.push_back(&row);
    }
  }
  return rows;
}

std::vector<std::size_t> styles_of_rows(const std::vector<const TableRow*>& rows,
                                        const RowStyles& book) {
  std::vector<std::string> names;
  for (const TableRow* row : rows) names.push_back(row->name);
  return experiments::styles_for(names, book);
}

ChartAxis axis_of(Metric metric) {
  ChartAxis axis;
  axis.title = experiments::short_title_of(metric);
  if (metric == Metric::kSuccessRate || metric == Metric::kProgress) axis.high = 1.0;
  return axis;
}

/// Whether anything is to be seen: a picture in which all is alike, as when every run succeeds,
/// shows less than its table.
bool differs(const ResultTable& table) {
  std::optional<double> first;
  for (const TableRow& row : table.rows) {
    for (const TableValue& value : row.values) {
      if (!value.mean) continue;
      if (std::abs(*value.mean - first.value_or(*value.mean)) > kVisible) return true;
      if (!first) first = value.mean;
    }
  }
  return false;
}

/// A group of bars per crew, the paper's figures as diamonds.
std::string bars(const Experiment& experiment, const ResultTable& table, const RowStyles& book) {
  BarChart chart;
  chart.frame.title = experiment.title;
  chart.frame.width = kWide;
  chart.frame.height = kHigh;
  chart.category_title = "crew";
  chart.categories = table.columns;
  chart.y = axis_of(table.metric);
  chart.from_zero = table.metric != Metric::kMakespan;
  const auto rows = rows_with_numbers(table);
  const auto styles = styles_of_rows(rows, book);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    BarSeries series{.name = rows[r]->name, .style = styles[r]};
    for (const TableValue& value : rows[r]->values) {
      series.bars.push_back({.value = value.mean.value_or(kMissing),
                             .low = value.low.value_or(kMissing),
                             .high = value.high.value_or(kMissing),
                             .reference = value.paper.value_or(kMissing)});
    }
    chart.series.push_back(std::move(series));
    if (rows[r]->has_paper()) chart.reference_name = "paper";
  }
  return bar_chart_svg(chart);
}

/// A line per row over the quantities ordered. Without intervals: a dozen bands over one another
/// hide more than they show.
std::string lines(const Experiment& experiment, const ResultTable& table, const RowStyles& book) {
  LineChart chart;
  chart.frame.title = experiment.title;
  chart.frame.width = kWide;
  chart.frame.height = kLineHigh;
  chart.x.title = "quantity ordered";
  chart.x.integer = true;
  chart.y = axis_of(table.metric);
  chart.y.low = 0.0;
  const auto rows = rows_with_numbers(table);
  const auto styles = styles_of_rows(rows, book);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    LineSeries series{.name = rows[r]->name, .style = styles[r], .markers = true};
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      series.points.push_back({.x = static_cast<double>(experiment.orders[c]),
                               .y = rows[r]->values[c].mean.value_or(kMissing)});
    }
    chart.series.push_back(std::move(series));
  }
  return line_chart_svg(chart);
}

std::string caption_of(const Experiment& experiment, const ResultTable& table) {
  std::string text = fmt::format("{} ", title_of(table.metric));
  if (experiment.columns == Experiment::Columns::kOrders) {
    return text + "over the quantity ordered; mean of all crews.";
  }
  text += "by crew. Whiskers: 95 % intervals.";
  const bool paper = std::any_of(table.rows.begin(), table.rows.end(),
                                 [](const TableRow& row) { return row.has_paper(); });
  if (paper) text += " Diamonds: the paper.";
  if (table.metric == Metric::kMakespan) text += " The axis does not begin at zero.";
  return text;
}

}  // namespace

std::vector<Figure> table_figures(const ExperimentResult& result, const RowStyles& styles) {
  std::vector<Figure> figures;
  const Experiment& experiment = result.experiment;
  if (experiment.columns == Experiment::Columns::kTraining) return figures;
  for (const ResultTable& table : result.tables) {
    if (!differs(table)) continue;
    figures.push_back({.name = experiment.name + "_" + name_of(table.metric),
                       .caption = caption_of(experiment, table),
                       .svg = experiment.columns == Experiment::Columns::kCrews
                                  ? bars(experiment, table, styles)
                                  : lines(experiment, table, styles),
                       .wide = true});
  }
  return figures;
}

}  // namespace linewright
