#include "adam.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "torch_values.hpp"

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

double Adam::clipped_step(torch::Tensor parameters, torch::Tensor gradient, double clip,
                          double learning_rate) {
  const auto norm = gradient.norm().item<double>();
  if (!std::isfinite(norm)) return norm;
  if (norm > clip) gradient.mul_(clip / norm);
  step(std::move(parameters), gradient, learning_rate);
  return norm;
}

void Adam::store(LearnerState& state) const {
  state.adam_mean = numbers_of(mean);
  state.adam_square = numbers_of(square);
  state.steps = steps;
}

void Adam::restore(const LearnerState& state) {
  const std::size_t size = state.steps > 0 ? state.parameters.size() : 0;
  if (state.adam_mean.size() != size || state.adam_square.size() != size) {
    throw std::invalid_argument("the state is of another network");
  }
  const auto tensor = [](const std::vector<float>& values) {
    return values.empty() ? torch::Tensor()
                          : torch::tensor(values, torch::kFloat32).to(default_device());
  };
  mean = tensor(state.adam_mean);
  square = tensor(state.adam_square);
  steps = state.steps;
}

}  // namespace linewright::learning
