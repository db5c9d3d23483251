#pragma once

#include <cstdint>
#include <vector>

#include "linewright/base/random.hpp"

namespace linewright {

/// What an update did.
struct UpdateReport {
  double loss = 0.0;           ///< what was minimised, mean over the batch
  double mean_q = 0.0;         ///< mean value of what was chosen: Q, or the critic's state value
  double gradient_norm = 0.0;  ///< before clipping
  [[nodiscard]] bool finite() const;
};

/// Everything that a learner's next update depends on besides its batch.
struct LearnerState {
  std::vector<float> parameters;
  std::vector<float> target;     ///< of the target network; empty where there is none
  std::vector<float> adam_mean;  ///< empty before the first update
  std::vector<float> adam_square;
  std::vector<float> average;  ///< running mean of the parameters; empty without averaging
  std::int64_t steps = 0;
  RandomStream::State noise{};
};

}  // namespace linewright
