#include "number_text.hpp"

#include <fmt/format.h>

#include <cmath>

namespace linewright::experiments {
namespace {

int decimals_of(double value, Metric metric) {
  if (metric == Metric::kTraining) {
    const double size = std::abs(value);
    if (std::round(value) == value) return 0;
    return size >= 1000.0 ? 0 : size >= 10.0 ? 1 : 2;
  }
  return metric == Metric::kSuccessRate || metric == Metric::kProgress ? 3 : 1;
}

std::string fixed(double value, int decimals) { return fmt::format("{:.{}f}", value, decimals); }

}  // namespace

std::string number_text(double value, Metric metric) {
  return fixed(value, decimals_of(value, metric));
}

std::string value_text(const TableValue& value, Metric metric, const std::string& plus_minus) {
  if (!value.mean) return "";
  const int decimals = decimals_of(*value.mean, metric);
  std::string text = fixed(*value.mean, decimals);
  if (!value.ci95 || fixed(*value.ci95, decimals) == fixed(0.0, decimals)) return text;
  const bool cut =
      *value.low > *value.mean - *value.ci95 || *value.high < *value.mean + *value.ci95;
  if (!cut) return text + plus_minus + fixed(*value.ci95, decimals);
  return text +
         fmt::format(" ({} to {})", fixed(*value.low, decimals), fixed(*value.high, decimals));
}

std::string paper_text(const TableValue& value, Metric metric) {
  return value.paper ? number_text(*value.paper, metric) : "";
}

std::string ratio_text(const TableValue& value) {
  const auto ratio = value.ratio();
  if (!ratio) return "";
  return *ratio >= 0.1 ? fixed(*ratio, 3) : fmt::format("{:.2g}", *ratio);
}

std::string samples_text(const TableRow& row) {
  std::string unit = name_of(row.over);
  if (row.samples == 1) unit.pop_back();
  return fmt::format("{} {}", row.samples, unit);
}

std::string over_text(const JudgedClaim& claim) {
  if (claim.lower_over == claim.than_over) return fmt::format("over {}", name_of(claim.lower_over));
  return fmt::format("over {} and {}", name_of(claim.lower_over), name_of(claim.than_over));
}

std::string what_was_run(const Experiment& experiment) {
  const std::string seeds = fmt::format("Training seeds {}.", fmt::join(experiment.seeds, ", "));
  if (experiment.columns == Experiment::Columns::kTraining) {
    return seeds + " Intervals: 95 %, over the training seeds.";
  }
  std::string fewer;
  for (const ExperimentRow& row : experiment.rows) {
    if (!row.trials || *row.trials >= experiment.trials) continue;
    fewer += fmt::format("{}{}: {}", fewer.empty() ? " (" : ", ", row.name, *row.trials);
  }
  if (!fewer.empty()) fewer += ")";
  return fmt::format(
      "{} runs per crew and order{}, starts from seed {}, {} shield. {} Intervals: 95 %, over the "
      "training seeds of an algorithm where there are several, else over the starts.",
      experiment.trials, fewer, experiment.starts_seed, experiment.shield ? "with" : "without",
      seeds);
}

}  // namespace linewright::experiments
