#pragma once

#include <cstdint>
#include <vector>

#include "linewright/environment/vector_environment.hpp"
#include "linewright/training/episode.hpp"

namespace linewright::learning {

/// Plays episodes of a plan again from their decisions alone: a checkpoint keeps two bytes per
/// decision instead of an observation.
class EpisodeReplayer {
 public:
  /// The simulator must outlive it.
  EpisodeReplayer(const Simulator& simulator, EpisodePlan plan, const std::string& allocator,
                  const RewardOptions& rewards, const PauseOptions& pauses);

  /// Episode `number` with these decisions, finished or not. Throws std::invalid_argument when one
  /// of them cannot be taken: the decisions are not of this plan.
  [[nodiscard]] Episode play(std::uint64_t number, const std::vector<std::uint16_t>& actions);

 private:
  const Simulator& simulator_;
  EpisodePlan plan_;
  ObservationEncoder encoder_;
  Environment environment_;
};

}  // namespace linewright::learning
