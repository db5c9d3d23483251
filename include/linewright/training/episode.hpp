#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "linewright/base/tick.hpp"

namespace linewright {

/// Sizes of one observation (ObservationSpec::feature_count(), token_count(), actions.size()).
struct ObservationSize {
  std::size_t features = 0;
  std::size_t tokens = 0;
  std::size_t actions = 0;

  friend bool operator==(const ObservationSize&, const ObservationSize&) = default;
};

/// How an episode ended. A deadlock and a run into the horizon are failures, and terminal.
struct EpisodeOutcome {
  bool success = false;
  Tick makespan = 0;  ///< of a success, ticks
  Tick horizon = 0;   ///< ticks allowed
};

/// The decisions of one episode, column by column: the temporary buffer D' of the paper (Sec.
/// 3.3.3). Row t holds what was seen before decision t, the action chosen, and the reward that came
/// of it (r_{t+1}: paid until the next decision or the end).
struct Episode {
  ObservationSize observation;
  std::vector<float> features;           ///< [size() x features]
  std::vector<std::uint8_t> present;     ///< [size() x tokens]
  std::vector<std::uint8_t> selectable;  ///< [size() x actions]
  std::vector<std::uint16_t> action;     ///< [size()], < actions
  std::vector<float> reward;             ///< [size()]
  EpisodeOutcome outcome;

  [[nodiscard]] std::size_t size() const { return action.size(); }
  /// Forgets the decisions; keeps the memory for the next episode.
  void clear();
  /// Adds a decision; the spans have the sizes of `observation`. Its reward is 0 until `reward` of
  /// that row is set: it is known only at the next decision.
  void add(std::span<const float> seen, std::span<const std::uint8_t> present_tokens,
           std::span<const std::uint8_t> selectable_actions, std::size_t chosen);
};

/// Throws std::invalid_argument when a column has not the length that the others ask for, or an
/// action is none of the observation's.
void check_episode(const Episode& episode);

}  // namespace linewright
