#include "episode_replay.hpp"

#include <stdexcept>
#include <utility>

#include "collector.hpp"

namespace linewright::learning {

EpisodeReplayer::EpisodeReplayer(const Simulator& simulator, EpisodePlan plan,
                                 const std::string& allocator, const RewardOptions& rewards,
                                 const PauseOptions& pauses)
    : simulator_(simulator),
      plan_(std::move(plan)),
      encoder_(simulator),
      environment_(simulator, allocator, rewards, pauses) {}

Episode EpisodeReplayer::play(std::uint64_t number, const std::vector<std::uint16_t>& actions) {
  Episode episode;
  episode.observation = size_of(encoder_.spec());
  const ObservationSize& size = episode.observation;
  std::vector<float> features(size.features);
  std::vector<std::uint8_t> present(size.tokens);
  std::vector<std::uint8_t> selectable(size.actions);
  const PlannedEpisode planned = episode_of(plan_, number);
  environment_.reset(sample_setup(simulator_.line(), plan_.crews[planned.crew], planned.seed),
                     planned.seed);
  for (const std::uint16_t action : actions) {
    if (environment_.state().ended()) throw std::invalid_argument("the episode ends before");
    encoder_.encode(environment_.state(), {features.data(), present.data(), selectable.data()});
    if (action >= size.actions || selectable[action] == 0) {
      throw std::invalid_argument("a decision of the episode is not possible");
    }
    episode.add(features, present, selectable, action);
    const StepResult step = environment_.step(action);
    episode.reward.back() = step.reward;
    if (step.paused) episode.clear();  // as a Collector does
    if (step.ended) {
      episode.outcome = {step.success, environment_.makespan(), environment_.horizon()};
    }
  }
  return episode;
}

}  // namespace linewright::learning
