#pragma once

#include "linewright/training/episode.hpp"

namespace linewright {

/// Episode-end processing (paper, Sec. 3.3.3, eq. "modified", and Algorithm 1).
struct EpisodeEndOptions {
  bool modify = true;   ///< change the rewards; `false` leaves them and only copies successes
  double eta4 = 0.4;    ///< weight of the bonus of a success, >= 0
  double eta5 = 0.001;  ///< what every decision of a failure loses, >= 0
  int eta6 = 5;         ///< how often the decisions of a success are stored, >= 1
};

/// Judges a finished episode on its own result and changes its rewards in place: a success adds
/// eta4 * (horizon - makespan) / makespan to every one of them, a failure (deadlock or horizon)
/// takes eta5 off. Returns how often each decision is to be stored: eta6 after a success, else 1.
/// Holds for every episode, those of the warm-up too.
[[nodiscard]] int process_episode_end(Episode& episode, const EpisodeEndOptions& options);

}  // namespace linewright
