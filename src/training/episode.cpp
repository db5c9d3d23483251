#include "linewright/training/episode.hpp"

#include <algorithm>
#include <stdexcept>

namespace linewright {

void Episode::clear() {
  features.clear();
  present.clear();
  selectable.clear();
  action.clear();
  reward.clear();
  outcome = {};
}

void Episode::add(std::span<const float> seen, std::span<const std::uint8_t> present_tokens,
                  std::span<const std::uint8_t> selectable_actions, std::size_t chosen) {
  features.insert(features.end(), seen.begin(), seen.end());
  present.insert(present.end(), present_tokens.begin(), present_tokens.end());
  selectable.insert(selectable.end(), selectable_actions.begin(), selectable_actions.end());
  action.push_back(static_cast<std::uint16_t>(chosen));
  reward.push_back(0.0F);
}

void check_episode(const Episode& episode) {
  const std::size_t n = episode.size();
  const ObservationSize& size = episode.observation;
  if (episode.features.size() != n * size.features || episode.present.size() != n * size.tokens ||
      episode.selectable.size() != n * size.actions || episode.reward.size() != n) {
    throw std::invalid_argument("the columns of the episode differ in length");
  }
  const auto is_unknown = [&](std::uint16_t action) { return action >= size.actions; };
  if (std::any_of(episode.action.begin(), episode.action.end(), is_unknown)) {
    throw std::invalid_argument("the episode has an action that the observation has not");
  }
}

}  // namespace linewright
