#pragma once

#include "attention.hpp"

namespace linewright::learning {

/// Adam (Kingma and Ba, 2015) over one flat vector of parameters; all its state is in the open, so
/// that a checkpoint can hold it.
struct Adam {
  double beta1 = 0.9;
  double beta2 = 0.999;
  double epsilon = 1.5e-4;
  std::int64_t steps = 0;
  torch::Tensor mean;
  torch::Tensor square;

  /// One step against the gradient, in place.
  void step(torch::Tensor parameters, const torch::Tensor& gradient, double learning_rate);
};

}  // namespace linewright::learning
