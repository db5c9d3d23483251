#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "linewright/evaluation/statistics.hpp"
#include "linewright/evaluation/trials.hpp"
#include "linewright/line/line_model.hpp"
#include "linewright/scenario/scenario.hpp"

// What `evaluate` computes and how it shows it.
namespace linewright::cli {

/// Results of one configuration: by crew, and the means over the crews.
struct Evaluation {
  Configuration configuration;
  std::string folder;  ///< "policy:FOLDER" where that named the policy; else empty
  std::vector<std::vector<TrialResult>> trials;
  std::vector<TrialSummary> rows;

  [[nodiscard]] double mean(double (*value)(const TrialSummary&)) const {
    double sum = 0.0;
    for (const TrialSummary& row : rows) sum += value(row);
    return rows.empty() ? 0.0 : sum / static_cast<double>(rows.size());
  }
  [[nodiscard]] double makespan() const {
    return mean([](const TrialSummary& row) { return row.makespan.mean; });
  }
  [[nodiscard]] double success_rate() const {
    return mean([](const TrialSummary& row) { return row.success_rate; });
  }
  [[nodiscard]] double progress() const {
    return mean([](const TrialSummary& row) { return row.progress; });
  }
  [[nodiscard]] double distance_m() const {
    return mean([](const TrialSummary& row) { return row.distance_m.mean; });
  }
  [[nodiscard]] double distance_ticks() const {
    return mean([](const TrialSummary& row) { return row.distance_ticks.mean; });
  }
  [[nodiscard]] double decisions() const {
    return mean([](const TrialSummary& row) { return row.decisions; });
  }
};

/// Of all runs of an evaluation.
struct ShieldTotals {
  std::int64_t decisions = 0;
  std::size_t masked = 0;
  double us_per_decision = 0.0;
};
[[nodiscard]] ShieldTotals shield_totals(const Evaluation& evaluation);

/// "PLANNER+ALLOCATOR".
[[nodiscard]] std::string name_of(const Configuration& configuration);

/// Runs the plan with a progress bar; interrupted, it has the crews that are complete.
[[nodiscard]] Evaluation evaluate_one(const Scenario& scenario, const Configuration& configuration,
                                      const TrialPlan& plan);

/// Over all crews that both have.
[[nodiscard]] PairedComparison compare_all(const Evaluation& first, const Evaluation& second);

/// The allocators whose mean is the lowest: more than one when they are equal.
[[nodiscard]] std::vector<std::string> lowest(const std::vector<Evaluation>& evaluations,
                                              double (Evaluation::*mean)() const);

// Tables for people, each with its title.
[[nodiscard]] std::string evaluation_text(const LineModel& line, const Evaluation& evaluation);
/// What the shield ruled out and how long it took per decision; empty without a shield.
[[nodiscard]] std::string shield_text(const Evaluation& evaluation);
[[nodiscard]] std::string utilisation_text(const LineModel& line, const Evaluation& evaluation);
[[nodiscard]] std::string paired_text(const LineModel& line, const Evaluation& first,
                                      const Evaluation& second);
/// A table per quantity with a column per allocator, and which of them is lowest. One or more
/// evaluations of the same plan, all with every crew.
[[nodiscard]] std::string allocators_text(const LineModel& line,
                                          const std::vector<Evaluation>& evaluations);

/// One table with a row per configuration (all with every crew): makespan by crew, the paired
/// difference to the first, and how long decisions took.
[[nodiscard]] std::string planners_text(const LineModel& line,
                                        const std::vector<Evaluation>& evaluations);

/// Evaluations of the policies of one folder with one allocator: an algorithm's training seeds.
struct SeedGroup {
  std::string folder;  ///< "policy:FOLDER"
  std::string allocator;
  std::vector<const Evaluation*> seeds;

  /// Mean and interval over the seeds of a value of each.
  [[nodiscard]] Spread over_seeds(const std::function<double(const Evaluation&)>& value) const;
};

/// In their order; those that no folder named are left out.
[[nodiscard]] std::vector<SeedGroup> seed_groups(const std::vector<Evaluation>& evaluations);

/// A table with a row per group: makespan by crew, each with the 95 % interval over the training
/// seeds, and how the means differ from the first group's (Welch); empty without groups.
[[nodiscard]] std::string seeds_text(const LineModel& line,
                                     const std::vector<Evaluation>& evaluations);
[[nodiscard]] nlohmann::ordered_json seeds_json(const LineModel& line,
                                                const std::vector<Evaluation>& evaluations);

/// How long decisions took, over all crews and trials; zeros without any.
struct Latency {
  double p50_ms = 0.0;
  double p99_ms = 0.0;
  double max_ms = 0.0;
};
[[nodiscard]] Latency latency_of(const Evaluation& evaluation);

/// A row per configuration and crew; with `means` also one for the mean over the crews.
[[nodiscard]] std::string evaluation_csv(const LineModel& line,
                                         const std::vector<Evaluation>& evaluations, bool means);

// The objects of docs/cli.md, evaluate; allocators_json and planners_json: of several complete
// evaluations.
[[nodiscard]] nlohmann::ordered_json evaluation_json(const LineModel& line,
                                                     const Evaluation& evaluation);
[[nodiscard]] nlohmann::ordered_json paired_json(const LineModel& line, const Evaluation& first,
                                                 const Evaluation& second);
[[nodiscard]] nlohmann::ordered_json allocators_json(const LineModel& line,
                                                     const std::vector<Evaluation>& evaluations);
[[nodiscard]] nlohmann::ordered_json planners_json(const LineModel& line,
                                                   const std::vector<Evaluation>& evaluations);

}  // namespace linewright::cli
