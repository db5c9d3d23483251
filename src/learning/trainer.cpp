#include "linewright/learning/trainer.hpp"

#include <utility>

#include "dqn_trainer.hpp"
#include "ppo_trainer.hpp"

namespace linewright {

std::vector<RunOptions> training_crews(const LineModel& line, const RunSettings& settings) {
  std::vector<RunOptions> crews(1);
  for (const WorkerKind& kind : line.worker_kinds) {
    std::vector<RunOptions> more;
    for (const RunOptions& crew : crews) {
      for (std::int32_t count = kind.count.min; count <= kind.count.max; ++count) {
        more.push_back(crew);
        more.back().workers.emplace_back(count);
      }
    }
    crews = std::move(more);
  }
  for (RunOptions& crew : crews) {
    std::vector<std::pair<std::string, std::int32_t>> counts;
    for (std::size_t k = 0; k < line.worker_kinds.size(); ++k) {
      counts.emplace_back(line.worker_kinds[k].name, *crew.workers[k]);
    }
    crew.order = settings.order;
    crew.horizon = horizon_for(settings, counts);
  }
  return crews;
}

TrainingResult train(const TrainingRun& run, const TrainingHooks& hooks) {
  return run.options.algorithm.kind == AlgorithmSettings::Kind::kPpo
             ? learning::train_ppo(run, hooks)
             : learning::train_dqn(run, hooks);
}

}  // namespace linewright
