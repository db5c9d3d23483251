#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "linewright/training/episode.hpp"

namespace linewright {

inline constexpr ObservationSize kNumberedSize{.features = 3, .tokens = 2, .actions = 5};

/// For tests: an episode whose every row can be told from all others. Row t of episode `number` has
/// the features {number, t, number * 1000 + t}, the action (number + t) % 5, which is selectable,
/// and the reward t + 1.
inline Episode numbered_episode(std::size_t length, std::size_t number) {
  Episode episode;
  episode.observation = kNumberedSize;
  for (std::size_t t = 0; t < length; ++t) {
    const std::vector<float> features{static_cast<float>(number), static_cast<float>(t),
                                      static_cast<float>(number * 1000 + t)};
    const std::vector<std::uint8_t> present{static_cast<std::uint8_t>(t % 2), 1};
    std::vector<std::uint8_t> selectable(5, 0);
    selectable[(number + t) % 5] = 1;
    episode.add(features, present, selectable, (number + t) % 5);
    episode.reward[t] = static_cast<float>(t + 1);
  }
  return episode;
}

}  // namespace linewright
