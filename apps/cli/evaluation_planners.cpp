#include <fmt/format.h>

#include <algorithm>

#include "common.hpp"
#include "evaluation.hpp"

namespace linewright::cli {
namespace {

using Json = nlohmann::ordered_json;

bool any_fails(const std::vector<Evaluation>& evaluations) {
  return std::any_of(evaluations.begin(), evaluations.end(),
                     [](const Evaluation& e) { return e.success_rate() < 1.0; });
}

std::vector<std::string> best_of(const std::vector<Evaluation>& evaluations) {
  double least = evaluations[0].makespan();
  for (const Evaluation& evaluation : evaluations) least = std::min(least, evaluation.makespan());
  std::vector<std::string> names;
  for (const Evaluation& evaluation : evaluations) {
    if (evaluation.makespan() == least) names.push_back(name_of(evaluation.configuration));
  }
  return names;
}

}  // namespace

Latency latency_of(const Evaluation& evaluation) {
  std::vector<std::int64_t> all;
  for (const auto& crew : evaluation.trials) {
    for (const TrialResult& trial : crew) {
      all.insert(all.end(), trial.decision_ns.begin(), trial.decision_ns.end());
    }
  }
  if (all.empty()) return {};
  std::sort(all.begin(), all.end());
  const auto share = [&](double quantile) {
    const auto last = static_cast<double>(all.size() - 1);
    return static_cast<double>(all[static_cast<std::size_t>(quantile * last)]) / 1e6;
  };
  return {.p50_ms = share(0.5), .p99_ms = share(0.99), .max_ms = share(1.0)};
}

std::string planners_text(const LineModel& line, const std::vector<Evaluation>& evaluations) {
  const Evaluation& first = evaluations.at(0);
  const bool fails = any_fails(evaluations);
  std::vector<std::vector<std::string>> rows{{"planner", "allocator"}};
  for (const TrialSummary& row : first.rows) rows[0].push_back(crew_name(line, row.crew));
  for (const char* title : {"mean", "difference", "ci95"}) rows[0].emplace_back(title);
  if (fails) rows[0].emplace_back("success");
  for (const char* title : {"p50 ms", "p99 ms"}) rows[0].emplace_back(title);
  for (const Evaluation& evaluation : evaluations) {
    const Configuration& configuration = evaluation.configuration;
    std::vector<std::string> row{configuration.planner, configuration.allocator};
    for (const TrialSummary& crew : evaluation.rows) {
      row.push_back(fmt::format("{:.1f}", crew.makespan.mean));
    }
    const Spread difference = compare_all(first, evaluation).difference;
    const bool is_first = &evaluation == &first;
    row.push_back(fmt::format("{:.1f}", evaluation.makespan()));
    row.push_back(is_first ? "" : fmt::format("{:+.1f}", difference.mean));
    row.push_back(is_first ? "" : fmt::format("{:.1f}", difference.ci95));
    if (fails) row.push_back(fmt::format("{:.3f}", evaluation.success_rate()));
    const Latency latency = latency_of(evaluation);
    row.push_back(fmt::format("{:.4f}", latency.p50_ms));
    row.push_back(fmt::format("{:.4f}", latency.p99_ms));
    rows.push_back(std::move(row));
  }
  return fmt::format(
             "{}: {} trials per crew; mean makespan in ticks, differences trial by trial from the "
             "same starts, milliseconds per decision\n",
             line.name, first.trials.at(0).size()) +
         text_table(rows) +
         fmt::format("\nlowest mean makespan: {}\n", fmt::join(best_of(evaluations), ", "));
}

nlohmann::ordered_json planners_json(const LineModel& line,
                                     const std::vector<Evaluation>& evaluations) {
  Json object{{"evaluations", Json::array()}, {"paired", Json::array()}};
  for (const Evaluation& evaluation : evaluations) {
    const Configuration& configuration = evaluation.configuration;
    const Latency latency = latency_of(evaluation);
    Json& entry = object["evaluations"].emplace_back(evaluation_json(line, evaluation));
    entry["decision_ms"] = {
        {"p50", latency.p50_ms}, {"p99", latency.p99_ms}, {"max", latency.max_ms}};
    if (&evaluation == &evaluations[0]) continue;
    Json paired{{"planner", configuration.planner},
                {"allocator", configuration.allocator},
                {"minus", name_of(evaluations[0].configuration)}};
    paired.update(paired_json(line, evaluations[0], evaluation));
    object["paired"].push_back(std::move(paired));
  }
  object["lowest"] = {{"makespan", best_of(evaluations)}};
  return object;
}

}  // namespace linewright::cli
