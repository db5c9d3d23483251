#include "evaluation.hpp"

#include <algorithm>
#include <limits>

#include "common.hpp"

namespace linewright::cli {

std::string name_of(const Configuration& configuration) {
  return configuration.planner + "+" + configuration.allocator;
}

Evaluation evaluate_one(const Scenario& scenario, const Configuration& configuration,
                        const TrialPlan& plan) {
  Evaluation evaluation{.configuration = configuration, .trials = {}, .rows = {}};
  ProgressBar bar(name_of(configuration));
  evaluation.trials = run_trials(
      scenario, configuration, plan,
      [&](std::size_t done, std::size_t total) { bar.update(done, total); }, &interrupted());
  for (std::size_t c = 0; c < evaluation.trials.size(); ++c) {
    evaluation.rows.push_back(summarize(evaluation.trials[c], plan.crews[c]));
  }
  return evaluation;
}

PairedComparison compare_all(const Evaluation& first, const Evaluation& second) {
  std::vector<TrialResult> a;
  std::vector<TrialResult> b;
  for (std::size_t c = 0; c < std::min(first.trials.size(), second.trials.size()); ++c) {
    a.insert(a.end(), first.trials[c].begin(), first.trials[c].end());
    b.insert(b.end(), second.trials[c].begin(), second.trials[c].end());
  }
  return compare_paired(a, b);
}

std::vector<std::string> lowest(const std::vector<Evaluation>& evaluations,
                                double (Evaluation::*mean)() const) {
  double least = std::numeric_limits<double>::infinity();
  for (const Evaluation& evaluation : evaluations) least = std::min(least, (evaluation.*mean)());
  std::vector<std::string> names;
  for (const Evaluation& evaluation : evaluations) {
    if ((evaluation.*mean)() == least) names.push_back(evaluation.configuration.allocator);
  }
  return names;
}

ShieldTotals shield_totals(const Evaluation& evaluation) {
  ShieldTotals totals;
  std::int64_t ns = 0;
  for (const auto& crew : evaluation.trials) {
    for (const TrialResult& trial : crew) {
      totals.decisions += trial.decisions;
      totals.masked += trial.masked;
      ns += trial.shield_ns;
    }
  }
  if (totals.decisions > 0)
    totals.us_per_decision =
        static_cast<double>(ns) / 1000.0 / static_cast<double>(totals.decisions);
  return totals;
}

}  // namespace linewright::cli
