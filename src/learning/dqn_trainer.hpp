#pragma once

#include "linewright/learning/trainer.hpp"

namespace linewright::learning {

/// Efficient-buffer Q-learning (paper, Algorithm 1) and what it is compared with.
[[nodiscard]] TrainingResult train_dqn(const TrainingRun& run, const TrainingHooks& hooks);

}  // namespace linewright::learning
