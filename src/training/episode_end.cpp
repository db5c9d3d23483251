#include "linewright/training/episode_end.hpp"

#include <algorithm>

namespace linewright {
namespace {

double modification(const EpisodeOutcome& outcome, const EpisodeEndOptions& options) {
  if (!outcome.success) return -options.eta5;
  const double makespan = std::max<Tick>(outcome.makespan, 1);  // an order that was done at once
  return options.eta4 * (outcome.horizon - makespan) / makespan;
}

}  // namespace

int process_episode_end(Episode& episode, const EpisodeEndOptions& options) {
  if (options.modify) {
    const auto more = static_cast<float>(modification(episode.outcome, options));
    for (float& reward : episode.reward) reward += more;
  }
  return episode.outcome.success ? options.eta6 : 1;
}

}  // namespace linewright
