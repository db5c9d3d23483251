#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "linewright/charts/line_chart.hpp"
#include "linewright/experiments/figures.hpp"
#include "row_styles.hpp"

namespace linewright {
namespace {

using Records = std::vector<TrainingRecord>;

constexpr double kWide = 720.0;

/// One of the pictures.
struct Curve {
  const char* name;
  NumberTable TrainingRecord::*table;
  const char* column;
  const char* title;
  const char* of;
};

constexpr const char* kEpisodes = "training episodes";
constexpr const char* kGreedy = "evaluations";
constexpr Curve kCurves[] = {
    {"training_return", &TrainingRecord::progress, "reward", "Return", kEpisodes},
    {"training_makespan", &TrainingRecord::progress, "makespan", "Makespan, ticks", kEpisodes},
    {"training_progress", &TrainingRecord::progress, "progress", "Progress", kEpisodes},
    {"evaluation_makespan", &TrainingRecord::evaluations, "makespan", "Makespan, ticks", kGreedy},
    {"evaluation_progress", &TrainingRecord::evaluations, "progress", "Progress", kGreedy},
    {"evaluation_success", &TrainingRecord::evaluations, "success", "Success rate", kGreedy}};

std::string caption_of(const Curve& curve) {
  const char* of = curve.of == kGreedy
                       ? "of greedy evaluations during training, mean of all crews"
                       : "of the training episodes, with exploration, mean of the last hundred";
  return fmt::format("{} {}. Lines: mean of the seeds; bands: from the lowest to the highest.",
                     curve.title, of);
}

/// The column of one run by its updates; empty: not kept.
std::vector<LinePoint> points_of(const TrainingRecord& record, const Curve& curve) {
  const NumberTable& table = record.*curve.table;
  const auto x = table.find("updates");
  const auto y = table.find(curve.column);
  std::vector<LinePoint> points;
  if (!x || !y) return points;
  for (const std::vector<double>& row : table.rows) {
    points.push_back({.x = row[*x], .y = row[*y]});
  }
  return points;
}

/// Between two points of the line the straight way; none before its beginning and behind its end.
double at(const std::vector<LinePoint>& line, double x) {
  const auto right =
      std::find_if(line.begin(), line.end(), [&](const LinePoint& point) { return point.x >= x; });
  if (right == line.end() || (right == line.begin() && right->x > x)) return kMissing;
  if (right->x == x) return right->y;
  const LinePoint& left = *(right - 1);
  return left.y + (right->y - left.y) * (x - left.x) / (right->x - left.x);
}

/// The mean of the seeds, in a band from the lowest to the highest. Where a seed has no number the
/// others count.
std::vector<LinePoint> banded(const Records& seeds, const Curve& curve) {
  std::vector<std::vector<LinePoint>> lines;
  for (const TrainingRecord& record : seeds) {
    lines.push_back(points_of(record, curve));
    if (lines.back().empty()) lines.pop_back();
  }
  std::vector<LinePoint> points = lines.empty() ? std::vector<LinePoint>{} : lines.front();
  for (LinePoint& point : points) {
    double sum = 0.0;
    double count = 0.0;
    for (const std::vector<LinePoint>& line : lines) {
      const double y = at(line, point.x);
      if (y != y) continue;  // missing
      sum += y;
      count += 1.0;
      point.y_low = count > 1.0 ? std::min(point.y_low, y) : y;
      point.y_high = count > 1.0 ? std::max(point.y_high, y) : y;
    }
    point.y = sum / count;
    if (count > 1.0) continue;
    point.y_low = kMissing;
    point.y_high = kMissing;
  }
  return points;
}

Figure figure_of(const Experiment& experiment, const std::vector<Records>& records,
                 const Curve& curve, const RowStyles& book) {
  LineChart chart;
  chart.frame.title = fmt::format("{}: {}", experiment.title, curve.of);
  chart.frame.width = kWide;
  chart.x.title = "updates";
  chart.y.title = curve.title;
  const std::string_view column = curve.column;
  if (column == "progress" || column == "success") chart.y.high = 1.0;
  std::vector<std::string> names;
  for (const ExperimentRow& row : experiment.rows) names.push_back(row.name);
  const auto styles = experiments::styles_for(names, book);
  for (std::size_t r = 0; r < names.size(); ++r) {
    chart.series.push_back(
        {.name = names[r], .style = styles[r], .points = banded(records.at(r), curve)});
    if (chart.series.back().points.empty()) chart.series.pop_back();
  }
  Figure figure{.name = fmt::format("{}_{}", experiment.name, curve.name),
                .caption = caption_of(curve)};
  if (!chart.series.empty()) figure.svg = line_chart_svg(chart);
  return figure;
}

}  // namespace

std::vector<Figure> training_figures(const Experiment& experiment,
                                     const std::vector<Records>& records, const RowStyles& styles) {
  std::vector<Figure> figures;
  for (const Curve& curve : kCurves) {
    figures.push_back(figure_of(experiment, records, curve, styles));
    if (figures.back().svg.empty()) figures.pop_back();
  }
  return figures;
}

}  // namespace linewright
