#include "linewright/learning/ppo_learner.hpp"

#include <optional>

#include "adam.hpp"
#include "torch_network.hpp"
#include "torch_values.hpp"

namespace linewright {

using learning::TorchNetwork;
using learning::TorchNoise;
using Values = torch::Tensor;

struct PpoLearner::Parts {
  Parts(const ObservationSpec& spec, const NetworkOptions& options, const TensorMap& tensors,
        const PpoLearnerOptions& given)
      : settings(given),
        device(learning::default_device()),
        network(spec, options, tensors, device) {
    adam.epsilon = given.adam_epsilon;
  }

  PpoLearnerOptions settings;
  torch::Device device;
  TorchNetwork network;
  learning::Adam adam;
};

PpoLearner::PpoLearner(const ObservationSpec& spec, const NetworkOptions& network,
                       const TensorMap& tensors, const PpoLearnerOptions& options)
    : parts_(std::make_unique<Parts>(spec, network, tensors, options)) {}
PpoLearner::~PpoLearner() = default;

UpdateReport PpoLearner::update(const PpoBatch& batch, const Noise* noise, double learning_rate) {
  Parts& p = *parts_;
  const auto rows = static_cast<std::int64_t>(batch.size);
  const auto column = [&](const std::vector<float>& values) {
    return learning::view(values, {rows}, p.device);
  };
  std::optional<TorchNoise> drawn;
  if (noise != nullptr) drawn = learning::to_torch(*noise, p.device);
  const TorchNetwork::Output out = p.network.forward(
      learning::rows_of(batch.features, rows, p.device),
      learning::rows_of(batch.present, rows, p.device), drawn ? &*drawn : nullptr);
  // A finite stand-in for minus infinity: its gradient is 0, not undefined.
  const Values impossible = learning::rows_of(batch.selectable, rows, p.device).eq(0);
  const Values log_all = torch::log_softmax(out.actions.masked_fill(impossible, -1e9F), 1);
  const Values log_now =
      log_all.gather(1, learning::view(batch.action, {rows, 1}, p.device)).squeeze(1);
  const Values weight = column(batch.weight);
  const Values advantage = column(batch.advantage);
  const Values ratio = (log_now - column(batch.log_probability)).exp();
  const Values clipped = ratio.clamp(1.0 - p.settings.clip, 1.0 + p.settings.clip);
  const Values gain = torch::minimum(ratio * advantage, clipped * advantage);
  const Values critic = (out.value - column(batch.returns)).square();
  const Values entropy = -(log_all.exp() * log_all.masked_fill(impossible, 0.0F)).sum(1);
  const Values loss =
      (weight * (p.settings.value_coefficient * critic - gain - p.settings.entropy * entropy))
          .mean();
  p.network.forget_gradient();
  loss.backward();
  UpdateReport report{.loss = loss.item<double>(), .mean_q = out.value.mean().item<double>()};
  report.gradient_norm = p.adam.clipped_step(p.network.flat(), p.network.flat_gradient(),
                                             p.settings.gradient_clip, learning_rate);
  return report;
}

TensorMap PpoLearner::tensors() const { return parts_->network.store(); }

LearnerState PpoLearner::state() const {
  LearnerState state{.parameters = learning::numbers_of(parts_->network.flat())};
  parts_->adam.store(state);
  return state;
}

void PpoLearner::restore(const LearnerState& state) {
  parts_->network.load_flat(state.parameters);
  parts_->adam.restore(state);
}

}  // namespace linewright
