#pragma once

#include "attention.hpp"
#include "linewright/learning/learner_state.hpp"

namespace linewright::learning {

/// Adam (Kingma and Ba, 2015) over one flat vector of parameters, which also keeps a running mean
/// of them (Polyak and Juditsky, 1992); all its state is in the open, so that a checkpoint can hold
/// it.
struct Adam {
  double beta1 = 0.9;
  double beta2 = 0.999;
  double epsilon = 1.5e-4;
  std::int64_t steps = 0;
  torch::Tensor mean;
  torch::Tensor square;
  double average_decay = 0.0;  ///< share of the running mean that an update keeps; 0: no mean
  torch::Tensor average;       ///< running mean of the parameters; undefined: none

  /// One step against the gradient, in place.
  void step(torch::Tensor parameters, const torch::Tensor& gradient, double learning_rate);

  /// Clips the gradient to `clip`, takes the step and returns the norm before clipping. When that
  /// is not finite, nothing changes.
  double clipped_step(torch::Tensor parameters, torch::Tensor gradient, double clip,
                      double learning_rate);

  /// The running mean where there is one, else the parameters themselves.
  [[nodiscard]] const torch::Tensor& averaged(const torch::Tensor& parameters) const {
    return average.defined() ? average : parameters;
  }

  void store(LearnerState& state) const;
  /// Throws std::invalid_argument when its parts do not fit together.
  void restore(const LearnerState& state);
};

}  // namespace linewright::learning
