#include "linewright/learning/q_learner.hpp"

#include <limits>

#include "adam.hpp"
#include "torch_network.hpp"
#include "torch_values.hpp"

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

BatchTensors tensors_of(const ReplayBatch& batch, torch::Device device) {
  const auto rows = static_cast<std::int64_t>(batch.size);
  return {learning::rows_of(batch.features, rows, device),
          learning::rows_of(batch.present, rows, device),
          learning::view(batch.action, {rows}, device),
          learning::view(batch.returns, {rows}, device),
          learning::view(batch.discount, {rows}, device),
          learning::rows_of(batch.next_features, rows, device),
          learning::rows_of(batch.next_present, rows, device),
          learning::rows_of(batch.next_selectable, rows, device),
          learning::view(batch.weight, {rows}, device)};
}

}  // namespace

struct QLearner::Parts {
  Parts(const ObservationSpec& spec, const NetworkOptions& network, const TensorMap& tensors,
        const QLearnerOptions& given, std::uint64_t seed)
      : options(given),
        device(learning::default_device()),
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
  UpdateReport report{.loss = loss.item<double>(), .mean_q = q.mean().item<double>()};
  td_errors = learning::numbers_of(error);
  report.gradient_norm = p.adam.clipped_step(p.online.flat(), p.online.flat_gradient(),
                                             p.options.gradient_clip, learning_rate);
  return report;
}

void QLearner::copy_target() {
  const torch::NoGradGuard no_gradient;
  Values(parts_->target.flat()).copy_(parts_->online.flat());
}

TensorMap QLearner::tensors() const { return parts_->online.store(); }

LearnerState QLearner::state() const {
  LearnerState state{.parameters = learning::numbers_of(parts_->online.flat()),
                     .target = learning::numbers_of(parts_->target.flat()),
                     .noise = parts_->random.state()};
  parts_->adam.store(state);
  return state;
}

void QLearner::restore(const LearnerState& state) {
  parts_->online.load_flat(state.parameters);
  parts_->target.load_flat(state.target);
  parts_->adam.restore(state);
  parts_->random.restore(state.noise);
}

}  // namespace linewright
