#include <fmt/format.h>

#include <algorithm>

#include "common.hpp"
#include "evaluation.hpp"

namespace linewright::cli {
namespace {

std::string table_of(const LineModel& line, const Evaluation& evaluation) {
  std::vector<std::vector<std::string>> rows{
      {"crew", "makespan", "ci95", "sd", "success", "progress", "metres", "ticks", "decisions"}};
  const auto add = [&](std::string crew, const TrialSummary& row) {
    rows.push_back({std::move(crew), fmt::format("{:.2f}", row.makespan.mean),
                    fmt::format("{:.2f}", row.makespan.ci95),
                    fmt::format("{:.2f}", row.makespan.sd), fmt::format("{:.3f}", row.success_rate),
                    fmt::format("{:.3f}", row.progress), fmt::format("{:.0f}", row.distance_m.mean),
                    fmt::format("{:.0f}", row.distance_ticks.mean),
                    fmt::format("{:.1f}", row.decisions)});
  };
  for (const TrialSummary& row : evaluation.rows) add(crew_name(line, row.crew), row);
  rows.push_back({"mean", fmt::format("{:.2f}", evaluation.makespan()), "", "",
                  fmt::format("{:.3f}", evaluation.success_rate()),
                  fmt::format("{:.3f}", evaluation.progress()),
                  fmt::format("{:.0f}", evaluation.distance_m()),
                  fmt::format("{:.0f}", evaluation.distance_ticks()),
                  fmt::format("{:.1f}", evaluation.decisions())});
  return text_table(rows);
}

/// A quantity of a crew, and its mean over the crews.
struct Quantity {
  const char* title;
  int decimals;
  double (*of_row)(const TrialSummary&);
  double (Evaluation::*mean)() const;
};

constexpr Quantity kMakespan{"makespan, ticks", 2,
                             [](const TrialSummary& row) { return row.makespan.mean; },
                             &Evaluation::makespan};
constexpr Quantity kDistance{"distance, metres", 0,
                             [](const TrialSummary& row) { return row.distance_m.mean; },
                             &Evaluation::distance_m};
constexpr Quantity kSuccess{"success rate", 3,
                            [](const TrialSummary& row) { return row.success_rate; },
                            &Evaluation::success_rate};

/// A column per allocator.
std::string side_by_side(const LineModel& line, const std::vector<Evaluation>& evaluations,
                         const Quantity& quantity) {
  const std::size_t crews = evaluations[0].rows.size();
  std::vector<std::vector<std::string>> rows(crews + 2);
  rows[0].emplace_back("crew");
  for (std::size_t c = 0; c < crews; ++c) {
    rows[c + 1].push_back(crew_name(line, evaluations[0].rows[c].crew));
  }
  rows.back().emplace_back("mean");
  for (const Evaluation& evaluation : evaluations) {
    const auto number = [&](double value) {
      return fmt::format("{:.{}f}", value, quantity.decimals);
    };
    rows[0].push_back(evaluation.configuration.allocator);
    for (std::size_t c = 0; c < crews; ++c) {
      rows[c + 1].push_back(number(quantity.of_row(evaluation.rows[c])));
    }
    rows.back().push_back(number((evaluation.*quantity.mean)()));
  }
  return fmt::format("\n{}\n", quantity.title) + text_table(rows);
}

/// All crews together, each allocator against the first.
std::string paired_with_first(const std::vector<Evaluation>& evaluations) {
  std::vector<std::vector<std::string>> rows{
      {"allocator", "difference", "ci95", "faster", "equal", "slower"}};
  for (std::size_t e = 1; e < evaluations.size(); ++e) {
    const PairedComparison c = compare_all(evaluations[0], evaluations[e]);
    rows.push_back({evaluations[e].configuration.allocator,
                    fmt::format("{:+.2f}", c.difference.mean),
                    fmt::format("{:.2f}", c.difference.ci95), std::to_string(c.faster),
                    std::to_string(c.equal), std::to_string(c.slower)});
  }
  return fmt::format("\nminus {}, ticks of makespan, trial by trial from the same starts\n",
                     evaluations[0].configuration.allocator) +
         text_table(rows);
}

}  // namespace

std::string evaluation_text(const LineModel& line, const Evaluation& evaluation) {
  return fmt::format("{}, {}: {} trials per crew\n", line.name, name_of(evaluation.configuration),
                     evaluation.trials.empty() ? 0 : evaluation.trials[0].size()) +
         table_of(line, evaluation);
}

std::string utilisation_text(const LineModel& line, const Evaluation& evaluation) {
  std::string text;
  for (const TrialSummary& row : evaluation.rows) {
    std::vector<std::vector<std::string>> rows{
        {crew_name(line, row.crew), "work", "travel", "wait", "idle"}};
    std::size_t id = 0;
    for (std::size_t k = 0; k < row.crew.size(); ++k) {
      for (std::int32_t i = 0; i < row.crew[k]; ++i, ++id) {
        const WorkerShares& shares = row.workers[id];
        rows.push_back({fmt::format("{}.{}", line.worker_kinds[k].name, i), percent(shares.work),
                        percent(shares.travel), percent(shares.wait), percent(shares.idle)});
      }
    }
    for (std::size_t m = 0; m < row.machines.size(); ++m) {
      rows.push_back({line.machines[m].name, percent(row.machines[m])});
    }
    text += "\n" + text_table(rows);
  }
  return text;
}

std::string paired_text(const LineModel& line, const Evaluation& first, const Evaluation& second) {
  std::vector<std::vector<std::string>> rows{
      {"crew", "difference", "ci95", "faster", "equal", "slower"}};
  const auto add = [&](std::string crew, const PairedComparison& c) {
    rows.push_back({std::move(crew), fmt::format("{:+.2f}", c.difference.mean),
                    fmt::format("{:.2f}", c.difference.ci95), std::to_string(c.faster),
                    std::to_string(c.equal), std::to_string(c.slower)});
  };
  for (std::size_t c = 0; c < std::min(first.trials.size(), second.trials.size()); ++c) {
    add(crew_name(line, second.rows[c].crew), compare_paired(first.trials[c], second.trials[c]));
  }
  add("all", compare_all(first, second));
  return fmt::format("\n{} minus {}, ticks of makespan, trial by trial from the same starts\n",
                     name_of(second.configuration), name_of(first.configuration)) +
         text_table(rows);
}

std::string allocators_text(const LineModel& line, const std::vector<Evaluation>& evaluations) {
  const Evaluation& first = evaluations.at(0);
  std::string text = fmt::format("{}, {}: {} trials per crew and allocator\n", line.name,
                                 first.configuration.planner, first.trials.at(0).size());
  text += side_by_side(line, evaluations, kMakespan) + side_by_side(line, evaluations, kDistance);
  const auto fails = [](const Evaluation& evaluation) { return evaluation.success_rate() < 1.0; };
  if (std::any_of(evaluations.begin(), evaluations.end(), fails)) {
    text += side_by_side(line, evaluations, kSuccess);
  }
  if (evaluations.size() > 1) text += paired_with_first(evaluations);
  return text + fmt::format("\nlowest mean makespan: {}\nlowest mean distance: {}\n",
                            fmt::join(lowest(evaluations, &Evaluation::makespan), ", "),
                            fmt::join(lowest(evaluations, &Evaluation::distance_m), ", "));
}

std::string shield_text(const Evaluation& evaluation) {
  if (!evaluation.configuration.shield) return {};
  const ShieldTotals totals = shield_totals(evaluation);
  return fmt::format("shield: {} decisions ruled out, {} taken; {:.1f} us per decision\n",
                     totals.masked, totals.decisions, totals.us_per_decision);
}

}  // namespace linewright::cli
