#pragma once

#include <vector>

#include "linewright/learning/trainer.hpp"

namespace linewright::learning {

/// Proximal policy optimisation on the same trunk, with the paper's episode-end processing (EPPO).
[[nodiscard]] TrainingResult train_ppo(const TrainingRun& run, const TrainingHooks& hooks);

/// Generalised advantage estimation (Schulman et al., 2016) over one whole episode, in its order:
/// A_t = delta_t + gamma lambda A_{t+1}, delta_t = r_{t+1} + gamma V_{t+1} - V_t, nothing behind
/// the last decision.
[[nodiscard]] std::vector<float> advantages_of(const std::vector<float>& rewards,
                                               const std::vector<float>& values, double gamma,
                                               double lambda);

}  // namespace linewright::learning
