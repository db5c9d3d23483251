#include <algorithm>

#include "linewright/charts/bar_chart.hpp"
#include "linewright/charts/line_chart.hpp"
#include "linewright/experiments/render.hpp"
#include "metric_titles.hpp"

namespace linewright {
namespace {

using experiments::title_of;

constexpr double kWide = 1000.0;  ///< a dozen rows by nine crews

/// Both ends of the interval, missing without one.
struct Ends {
  double low = kMissing;
  double high = kMissing;
};
Ends ends_of(const TableValue& value) {
  if (!value.ci95) return {};
  return {value.mean - *value.ci95, value.mean + *value.ci95};
}

/// A group of bars per crew, the paper's figures as diamonds.
std::string bars(const Experiment& experiment, const ResultTable& table) {
  BarChart chart{.frame = {.title = experiment.title, .width = kWide},
                 .category_title = "crew",
                 .categories = table.columns,
                 .y = {.title = title_of(table.metric)},
                 .from_zero = table.metric != Metric::kMakespan};
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    BarSeries series{.name = table.rows[r].name, .style = r};
    for (const TableValue& value : table.rows[r].values) {
      const Ends ends = ends_of(value);
      series.bars.push_back({.value = value.mean,
                             .low = ends.low,
                             .high = ends.high,
                             .reference = value.paper.value_or(kMissing)});
    }
    chart.series.push_back(std::move(series));
  }
  if (std::any_of(table.rows.begin(), table.rows.end(),
                  [](const TableRow& row) { return row.has_paper(); })) {
    chart.reference_name = "paper";
  }
  return bar_chart_svg(chart);
}

/// A line per row over the quantities ordered. Without intervals: a dozen bands over one another
/// hide more than they show.
std::string lines(const Experiment& experiment, const ResultTable& table) {
  LineChart chart{.frame = {.title = experiment.title, .width = kWide, .height = 520.0},
                  .x = {.title = "quantity ordered", .integer = true},
                  .y = {.title = title_of(table.metric), .low = 0.0}};
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    LineSeries series{.name = table.rows[r].name, .style = r, .markers = true};
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      series.points.push_back(
          {.x = static_cast<double>(experiment.orders[c]), .y = table.rows[r].values[c].mean});
    }
    chart.series.push_back(std::move(series));
  }
  return line_chart_svg(chart);
}

}  // namespace

std::string result_figure(const ExperimentResult& result, std::size_t table) {
  const ResultTable& shown = result.tables.at(table);
  return result.experiment.columns == Experiment::Columns::kCrews ? bars(result.experiment, shown)
                                                                  : lines(result.experiment, shown);
}

}  // namespace linewright
