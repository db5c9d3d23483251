#include "adam.hpp"

#include <algorithm>
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
  if (average_decay <= 0.0) return;
  if (!average.defined()) average = parameters.detach().clone();
  // The first ones count less, or the mean would long remember what was never learned.
  const double share = static_cast<double>(1 + steps) / static_cast<double>(10 + steps);
  average.lerp_(parameters, 1.0 - std::min(average_decay, share));
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
  state.average = numbers_of(average);
  state.steps = steps;
}

void Adam::restore(const LearnerState& state) {
  const std::size_t size = state.steps > 0 ? state.parameters.size() : 0;
  const std::size_t averages = average_decay > 0.0 ? size : 0;
  if (state.adam_mean.size() != size || state.adam_square.size() != size ||
      state.average.size() != averages) {
    throw std::invalid_argument("the state is of another network");
  }
  const auto tensor = [](const std::vector<float>& values) {
    return values.empty() ? torch::Tensor()
                          : torch::tensor(values, torch::kFloat32).to(default_device());
  };
  mean = tensor(state.adam_mean);
  square = tensor(state.adam_square);
  average = tensor(state.average);
  steps = state.steps;
}

}  // namespace linewright::learning
