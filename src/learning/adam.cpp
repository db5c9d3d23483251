#include "adam.hpp"

#include <cmath>

namespace linewright::learning {

void Adam::step(torch::Tensor parameters, const torch::Tensor& gradient, double learning_rate) {
  const torch::NoGradGuard no_gradient;
  if (!mean.defined()) {
    mean = torch::zeros_like(parameters);
    square = torch::zeros_like(parameters);
  }
  ++steps;
  mean.mul_(beta1).add_(gradient, 1.0 - beta1);
  square.mul_(beta2).addcmul_(gradient, gradient, 1.0 - beta2);
  const double correction1 = 1.0 - std::pow(beta1, static_cast<double>(steps));
  const double correction2 = 1.0 - std::pow(beta2, static_cast<double>(steps));
  const torch::Tensor scale = (square / correction2).sqrt_().add_(epsilon);
  parameters.addcdiv_(mean, scale, -learning_rate / correction1);
}

}  // namespace linewright::learning
