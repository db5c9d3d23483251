#include "linewright/learning/q_learner.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "adam.hpp"
#include "torch_network.hpp"

namespace linewright {

using learning::Adam;
using learning::TorchNetwork;
using learning::TorchNoise;
using Values = torch::Tensor;

namespace {

/// The batch as tensors that look into its memory.
struct BatchTensors {
  Values features, present, action, returns, discount, next_features, next_present, next_selectable,
      weight;
};

template <class Number>
Values view(const std::vector<Number>& values, std::vector<std::int64_t> shape,
            torch::ScalarType type) {
  // from_blob wants a pointer to non-const; nothing writes through it.
  return torch::from_blob(const_cast<Number*>(values.data()), shape, type);
}

BatchTensors tensors_of(const ReplayBatch& batch, torch::Device device) {
  const auto rows = static_cast<std::int64_t>(batch.size);
  const auto floats = [&](const std::vector<float>& values, std::int64_t columns) {
    Values all = view(values, {rows, columns}, torch::kFloat32);
    return (columns == 1 ? all.squeeze(1) : all).to(device);
  };
  const auto bytes = [&](const std::vector<std::uint8_t>& values) {
    const auto columns = static_cast<std::int64_t>(values.size()) / rows;
    return view(values, {rows, columns}, torch::kUInt8).to(device);
  };
  const auto width = static_cast<std::int64_t>(batch.features.size()) / rows;
  return {floats(batch.features, width),
          bytes(batch.present),
          view(batch.action, {rows}, torch::kInt64).to(device),
          floats(batch.returns, 1),
          floats(batch.discount, 1),
          floats(batch.next_features, width),
          bytes(batch.next_present),
          bytes(batch.next_selectable),
          floats(batch.weight, 1)};
}

std::vector<float> numbers(const Values& tensor) {
  if (!tensor.defined()) return {};
  const Values here = tensor.detach().cpu().contiguous();
  const float* first = here.data_ptr<float>();
  return {first, first + here.numel()};
}

}  // namespace

bool UpdateReport::finite() const {
  return std::isfinite(loss) && std::isfinite(mean_q) && std::isfinite(gradient_norm);
}

struct QLearner::Parts {
  Parts(const ObservationSpec& spec, const NetworkOptions& network, const TensorMap& tensors,
        const QLearnerOptions& given, std::uint64_t seed)
      : options(given),
        device(torch::cuda::is_available() ? torch::kCUDA : torch::kCPU),
        online(spec, network, tensors, device),
        target(spec, network, tensors, device),
        noise(Network(spec, network, tensors).make_noise()),
        random(RandomStream::derive(seed, "learner noise")) {
    adam.epsilon = options.adam_epsilon;
  }

  /// Fresh noise for a forward pass: online and target networks draw their own.
  TorchNoise draw() {
    sample_noise(random, noise);
    return learning::to_torch(noise, device);
  }

  /// r + gamma q_target(s', argmax q(s', .)); without double_q the target network chooses, too.
  Values targets(const BatchTensors& batch) {
    const torch::NoGradGuard no_gradient;
    const TorchNoise target_noise = draw();
    const Values rated =
        target.forward(batch.next_features, batch.next_present, &target_noise).actions;
    Values choice = rated;
    if (options.double_q) {
      const TorchNoise online_noise = draw();
      choice = online.forward(batch.next_features, batch.next_present, &online_noise).actions;
    }
    const Values masked =
        choice.masked_fill(batch.next_selectable.eq(0), -std::numeric_limits<float>::infinity());
    const Values next = rated.gather(1, masked.argmax(1, true)).squeeze(1);
    return batch.returns + batch.discount * next;
  }

  QLearnerOptions options;
  torch::Device device;
  TorchNetwork online;
  TorchNetwork target;
  Noise noise;
  RandomStream random;
  Adam adam;
};

QLearner::QLearner(const ObservationSpec& spec, const NetworkOptions& network,
                   const TensorMap& tensors, const QLearnerOptions& options, std::uint64_t seed)
    : parts_(std::make_unique<Parts>(spec, network, tensors, options, seed)) {}
QLearner::~QLearner() = default;

UpdateReport QLearner::update(const ReplayBatch& replayed, double learning_rate,
                              std::vector<float>& td_errors) {
  Parts& p = *parts_;
  const BatchTensors batch = tensors_of(replayed, p.device);
  const Values wanted = p.targets(batch);
  const TorchNoise noise = p.draw();
  const Values q = p.online.forward(batch.features, batch.present, &noise)
                       .actions.gather(1, batch.action.unsqueeze(1))
                       .squeeze(1);
  const Values error = wanted - q;
  const Values loss = (batch.weight * error * error).mean();
  p.online.forget_gradient();
  loss.backward();
  Values gradient = p.online.flat_gradient();
  UpdateReport report{.loss = loss.item<double>(),
                      .mean_q = q.mean().item<double>(),
                      .gradient_norm = gradient.norm().item<double>()};
  td_errors = numbers(error);
  if (!report.finite()) return report;
  if (report.gradient_norm > p.options.gradient_clip) {
    gradient.mul_(p.options.gradient_clip / report.gradient_norm);
  }
  p.adam.step(p.online.flat(), gradient, learning_rate);
  return report;
}

void QLearner::copy_target() {
  const torch::NoGradGuard no_gradient;
  Values(parts_->target.flat()).copy_(parts_->online.flat());
}

TensorMap QLearner::tensors() const { return parts_->online.store(); }

LearnerState QLearner::state() const {
  return {.parameters = numbers(parts_->online.flat()),
          .target = numbers(parts_->target.flat()),
          .adam_mean = numbers(parts_->adam.mean),
          .adam_square = numbers(parts_->adam.square),
          .steps = parts_->adam.steps,
          .noise = parts_->random.state()};
}

void QLearner::restore(const LearnerState& state) {
  const auto size = static_cast<std::size_t>(parts_->online.flat().numel());
  const bool begun = state.steps > 0;
  if (state.parameters.size() != size || state.target.size() != size ||
      state.adam_mean.size() != (begun ? size : 0) ||
      state.adam_square.size() != state.adam_mean.size()) {
    throw std::invalid_argument("the state is of another network");
  }
  const torch::NoGradGuard no_gradient;
  const auto tensor = [&](const std::vector<float>& values) {
    return torch::tensor(values, torch::kFloat32).to(parts_->device);
  };
  Values(parts_->online.flat()).copy_(tensor(state.parameters));
  Values(parts_->target.flat()).copy_(tensor(state.target));
  parts_->adam.mean = begun ? tensor(state.adam_mean) : Values();
  parts_->adam.square = begun ? tensor(state.adam_square) : Values();
  parts_->adam.steps = state.steps;
  parts_->random.restore(state.noise);
}

}  // namespace linewright
