#include <fmt/format.h>

#include <algorithm>

#include "common.hpp"
#include "evaluation.hpp"

namespace linewright::cli {
namespace {

using Json = nlohmann::ordered_json;

Json spread_json(const Spread& spread) {
  return {{"mean", spread.mean}, {"sd", spread.sd}, {"ci95", spread.ci95}};
}

Json row_json(const LineModel& line, const TrialSummary& row) {
  Json object{{"crew", crew_name(line, row.crew)}};
  for (std::size_t k = 0; k < row.crew.size(); ++k) {
    object[line.worker_kinds[k].name + "s"] = row.crew[k];
  }
  object["makespan"] = spread_json(row.makespan);
  object["success_rate"] = row.success_rate;
  object["progress"] = row.progress;
  object["distance"] = {{"metres", spread_json(row.distance_m)},
                        {"ticks", spread_json(row.distance_ticks)}};
  object["decisions"] = row.decisions;
  object["workers"] = Json::array();
  std::size_t id = 0;
  for (std::size_t k = 0; k < row.crew.size(); ++k) {
    for (std::int32_t i = 0; i < row.crew[k]; ++i, ++id) {
      const WorkerShares& shares = row.workers[id];
      object["workers"].push_back({{"id", fmt::format("{}.{}", line.worker_kinds[k].name, i)},
                                   {"work", shares.work},
                                   {"travel", shares.travel},
                                   {"wait", shares.wait},
                                   {"idle", shares.idle}});
    }
  }
  object["machines"] = Json::object();
  for (std::size_t m = 0; m < row.machines.size(); ++m)
    object["machines"][line.machines[m].name] = row.machines[m];
  return object;
}

Json comparison_json(const PairedComparison& comparison) {
  return {{"difference", spread_json(comparison.difference)},
          {"faster", comparison.faster},
          {"equal", comparison.equal},
          {"slower", comparison.slower}};
}

}  // namespace

nlohmann::ordered_json evaluation_json(const LineModel& line, const Evaluation& evaluation) {
  Json object{{"planner", evaluation.configuration.planner},
              {"allocator", evaluation.configuration.allocator},
              {"shield", evaluation.configuration.shield ? "on" : "off"},
              {"rows", Json::array()}};
  for (const TrialSummary& row : evaluation.rows) object["rows"].push_back(row_json(line, row));
  if (evaluation.configuration.shield) {
    object["ruled_out"] = shield_totals(evaluation).masked;  // no times: equal runs, equal output
  }
  object["mean_makespan"] = evaluation.makespan();
  object["success_rate"] = evaluation.success_rate();
  object["progress"] = evaluation.progress();
  return object;
}

nlohmann::ordered_json paired_json(const LineModel& line, const Evaluation& first,
                                   const Evaluation& second) {
  Json object = comparison_json(compare_all(first, second));
  object["rows"] = Json::array();
  for (std::size_t c = 0; c < std::min(first.trials.size(), second.trials.size()); ++c) {
    Json row = comparison_json(compare_paired(first.trials[c], second.trials[c]));
    row["crew"] = crew_name(line, second.rows[c].crew);
    object["rows"].push_back(std::move(row));
  }
  return object;
}

nlohmann::ordered_json allocators_json(const LineModel& line,
                                       const std::vector<Evaluation>& evaluations) {
  Json object{{"evaluations", Json::array()}, {"paired", Json::array()}};
  for (const Evaluation& evaluation : evaluations) {
    object["evaluations"].push_back(evaluation_json(line, evaluation));
    object["evaluations"].back()["mean_distance_m"] = evaluation.distance_m();
    if (&evaluation == &evaluations[0]) continue;
    Json paired{{"allocator", evaluation.configuration.allocator},
                {"minus", evaluations[0].configuration.allocator}};
    paired.update(paired_json(line, evaluations[0], evaluation));
    object["paired"].push_back(std::move(paired));
  }
  object["lowest"] = {{"makespan", lowest(evaluations, &Evaluation::makespan)},
                      {"distance_m", lowest(evaluations, &Evaluation::distance_m)}};
  return object;
}

}  // namespace linewright::cli
