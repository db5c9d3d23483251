#include <fmt/format.h>

#include "common.hpp"
#include "evaluation.hpp"

namespace linewright::cli {

std::string evaluation_csv(const LineModel& line, const std::vector<Evaluation>& evaluations,
                           bool means) {
  std::string text = "planner,allocator,crew";
  for (const WorkerKind& kind : line.worker_kinds) text += "," + kind.name + "s";
  text +=
      ",trials,makespan_mean,makespan_sd,makespan_ci95,success_rate,progress,distance_m_mean,"
      "distance_ticks_mean,decisions_mean\n";
  for (const Evaluation& evaluation : evaluations) {
    const Configuration& configuration = evaluation.configuration;
    for (const TrialSummary& row : evaluation.rows) {
      text += fmt::format("\"{}\",{},{}", configuration.planner, configuration.allocator,
                          crew_name(line, row.crew));
      for (const std::int32_t count : row.crew) text += fmt::format(",{}", count);
      text += fmt::format(",{},{},{},{},{},{},{},{},{}\n", row.makespan.count, row.makespan.mean,
                          row.makespan.sd, row.makespan.ci95, row.success_rate, row.progress,
                          row.distance_m.mean, row.distance_ticks.mean, row.decisions);
    }
    if (!means) continue;
    text +=
        fmt::format("\"{}\",{},mean{:,>{}},{},,,{},{},{},{},{}\n", configuration.planner,
                    configuration.allocator, "", line.worker_kinds.size() + 1,
                    evaluation.makespan(), evaluation.success_rate(), evaluation.progress(),
                    evaluation.distance_m(), evaluation.distance_ticks(), evaluation.decisions());
  }
  return text;
}

}  // namespace linewright::cli
