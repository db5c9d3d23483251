#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "linewright/charts/bar_chart.hpp"
#include "linewright/charts/radar_chart.hpp"
#include "linewright/experiments/figures.hpp"
#include "metric_titles.hpp"
#include "row_styles.hpp"

namespace linewright {
namespace {

constexpr double kVisible = 0.05;  ///< per cent
constexpr std::size_t kFewestForRadar = 3;
constexpr double kWidth = 900.0;
constexpr double kRadarHeight = 680.0;

/// A quantity in which rows are compared: a column, or all of them together.
struct Axis {
  std::string name;
  const ResultTable* table = nullptr;
  std::optional<std::size_t> column;  ///< none: the mean of all
};

/// Short: a radar has little room for names. Of training only how soon it was good: how long it
/// went on is what somebody asked for.
std::vector<Axis> axes_of(const ExperimentResult& result) {
  std::vector<Axis> axes;
  const Experiment& experiment = result.experiment;
  for (const ResultTable& table : result.tables) {
    if (table.metric == Metric::kTraining) {
      const auto column = std::find(table.columns.begin(), table.columns.end(), "minutes to 5 %");
      axes.push_back(
          {"time to 5 %", &table, static_cast<std::size_t>(column - table.columns.begin())});
      continue;
    }
    std::string name = experiments::word_of(table.metric);
    if (experiment.columns == Experiment::Columns::kOrders) {
      name += fmt::format(", {}–{}", experiment.orders.front(), experiment.orders.back());
    }
    axes.push_back({std::move(name), &table, std::nullopt});
  }
  return axes;
}

const TableRow* row_named(const ResultTable& table, const std::string& name) {
  const auto found = std::find_if(table.rows.begin(), table.rows.end(),
                                  [&](const TableRow& row) { return row.name == name; });
  return found == table.rows.end() ? nullptr : &*found;
}

std::optional<double> number_of(const Axis& axis, const std::string& row_name) {
  const TableRow* row = row_named(*axis.table, row_name);
  if (row == nullptr || row->values.empty()) return std::nullopt;
  if (axis.column) return row->values.at(*axis.column).mean;
  if (axis.table->columns.back() == "mean") return row->values.back().mean;
  double sum = 0.0;
  for (const TableValue& value : row->values) {
    if (!value.mean) return std::nullopt;
    sum += *value.mean;
  }
  return sum / static_cast<double>(row->values.size());
}

std::optional<double> percent_better(const Axis& axis, const std::string& row,
                                     const std::string& base) {
  const auto ours = number_of(axis, row);
  const auto theirs = number_of(axis, base);
  if (!ours || !theirs || *theirs == 0.0) return std::nullopt;
  const Metric metric = axis.table->metric;
  const bool more = metric == Metric::kSuccessRate || metric == Metric::kProgress;
  return 100.0 * (more ? *ours - *theirs : *theirs - *ours) / *theirs;
}

/// Rows of the first result that have a number on every axis.
std::vector<std::string> common_rows(const std::vector<Axis>& axes, const std::string& base) {
  std::vector<std::string> names;
  for (const TableRow& row : axes.front().table->rows) {
    const bool everywhere = std::all_of(axes.begin(), axes.end(), [&](const Axis& axis) {
      return percent_better(axis, row.name, base).has_value();
    });
    if (everywhere && row.name != base) names.push_back(row.name);
  }
  return names;
}

}  // namespace

Improvements improvements_of(const std::vector<ExperimentResult>& results) {
  Improvements all;
  std::vector<Axis> axes;
  for (const ExperimentResult& result : results) {
    const std::string& base = result.experiment.base;
    if (base.empty() || (!all.base.empty() && base != all.base)) continue;
    all.base = base;
    for (Axis& axis : axes_of(result)) {
      if (number_of(axis, base)) axes.push_back(std::move(axis));
    }
  }
  if (axes.empty()) return all;
  const std::vector<std::string> names = common_rows(axes, all.base);
  for (const std::string& name : names) all.rows.push_back({.name = name, .percent = {}});
  for (const Axis& axis : axes) {
    std::vector<double> percent;
    for (const std::string& name : names) {
      percent.push_back(percent_better(axis, name, all.base).value_or(0.0));
    }
    if (std::none_of(percent.begin(), percent.end(),
                     [](double value) { return std::abs(value) >= kVisible; })) {
      continue;
    }
    all.axes.push_back(axis.name);
    for (std::size_t r = 0; r < percent.size(); ++r) all.rows[r].percent.push_back(percent[r]);
  }
  return all;
}

Figure improvement_figure(const Improvements& improvements, const RowStyles& book) {
  const std::string title = fmt::format("Improvement over {}", improvements.base);
  Figure figure{.name = "improvement",
                .caption = fmt::format("By how many per cent each row is better than {}: shorter, "
                                       "or more often finished.",
                                       improvements.base)};
  std::vector<std::string> names;
  for (const Improvements::Row& row : improvements.rows) names.push_back(row.name);
  const auto styles = experiments::styles_for(names, book);
  if (improvements.axes.size() >= kFewestForRadar) {
    RadarChart chart;
    chart.frame.title = title;
    chart.frame.width = kWidth;
    chart.frame.height = kRadarHeight;
    chart.axes = improvements.axes;
    chart.scale.title = "per cent better";
    chart.base = 0.0;
    chart.base_name = improvements.base;
    for (std::size_t r = 0; r < names.size(); ++r) {
      chart.series.push_back({names[r], styles[r], improvements.rows[r].percent});
    }
    figure.svg = radar_chart_svg(chart);
    return figure;
  }
  BarChart chart;
  chart.frame.title = title;
  chart.frame.width = kWidth;
  chart.categories = improvements.axes;
  chart.y.title = "per cent better";
  for (std::size_t r = 0; r < names.size(); ++r) {
    BarSeries series{.name = names[r], .style = styles[r]};
    for (const double value : improvements.rows[r].percent) series.bars.push_back({.value = value});
    chart.series.push_back(std::move(series));
  }
  figure.svg = bar_chart_svg(chart);
  return figure;
}

}  // namespace linewright
