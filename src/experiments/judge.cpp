#include "judge.hpp"

#include <algorithm>

namespace linewright {
namespace experiments {

TableValue value_of(const Sample& sample, Metric metric) {
  TableValue value;
  if (sample.spread.count == 0) return value;
  value.mean = sample.spread.mean;
  if (sample.spread.count < 2) return value;
  const bool is_share = metric == Metric::kSuccessRate || metric == Metric::kProgress;
  value.ci95 = sample.spread.ci95;
  value.low = std::max(0.0, sample.spread.mean - sample.spread.ci95);
  value.high = sample.spread.mean + sample.spread.ci95;
  if (is_share) value.high = std::min(1.0, *value.high);
  return value;
}

JudgedClaim judged(const Claim& claim, const Sample& lower, const Sample& than) {
  JudgedClaim judged{.claim = claim,
                     .difference = welch_difference(than.spread, lower.spread),
                     .lower_over = lower.over,
                     .than_over = than.over};
  const auto [mean, ci95] = judged.difference;
  if (ci95 > 0.0 && mean + ci95 < 0.0) judged.verdict = JudgedClaim::Verdict::kHolds;
  if (ci95 > 0.0 && mean - ci95 > 0.0) judged.verdict = JudgedClaim::Verdict::kContrary;
  return judged;
}

std::size_t row_named(const Experiment& experiment, const std::string& name) {
  const auto found = std::find_if(experiment.rows.begin(), experiment.rows.end(),
                                  [&](const ExperimentRow& row) { return row.name == name; });
  return static_cast<std::size_t>(found - experiment.rows.begin());
}

}  // namespace experiments

std::optional<double> TableValue::ratio() const {
  if (!mean || !paper || *paper == 0.0) return std::nullopt;
  return *mean / *paper;
}

bool TableRow::has_paper() const {
  return std::any_of(values.begin(), values.end(),
                     [](const TableValue& value) { return value.paper.has_value(); });
}

const char* name_of(Sampled sampled) { return sampled == Sampled::kSeeds ? "seeds" : "starts"; }

const char* name_of(JudgedClaim::Verdict verdict) {
  switch (verdict) {
    case JudgedClaim::Verdict::kHolds:
      return "holds";
    case JudgedClaim::Verdict::kContrary:
      return "contrary";
    case JudgedClaim::Verdict::kOpen:
      return "open";
  }
  return "open";
}

}  // namespace linewright
