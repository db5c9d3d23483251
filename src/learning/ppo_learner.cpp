#include "linewright/learning/ppo_learner.hpp"

#include <optional>

#include "adam.hpp"
#include "slices.hpp"
#include "torch_network.hpp"
#include "torch_values.hpp"

namespace linewright {

using learning::TorchNetwork;
using learning::TorchNoise;
using Values = torch::Tensor;

namespace {

/// What came out for the rows of a slice.
struct Slice {
  double loss = 0.0;        ///< its part of the mean
  double mean_value = 0.0;  ///< likewise
  Values gradient;
};

}  // namespace

struct PpoLearner::Parts {
  Parts(const ObservationSpec& spec, const NetworkOptions& options, const TensorMap& tensors,
        const PpoLearnerOptions& given)
      : settings(given),
        device(learning::default_device()),
        network(spec, options, tensors, device),
        pool(given.threads) {
    adam.epsilon = given.adam_epsilon;
    adam.average_decay = given.average;
  }

  /// Loss and gradient of some rows of the batch, as their part of a mean over all of them.
  [[nodiscard]] Slice compute(const PpoBatch& batch, std::int64_t first, std::int64_t rows,
                              const TorchNoise* noise) const {
    const auto all = static_cast<std::int64_t>(batch.size);
    const torch::Device here(torch::kCPU);
    const auto part = [&](const Values& values) {
      return values.narrow(0, first, rows).to(device);
    };
    const auto column = [&](const std::vector<float>& values) {
      return part(learning::view(values, {all}, here));
    };
    const TorchNetwork::Output out =
        network.forward(part(learning::rows_of(batch.features, all, here)),
                        part(learning::rows_of(batch.present, all, here)), noise);
    // A finite stand-in for minus infinity: its gradient is 0, not undefined.
    const Values impossible = part(learning::rows_of(batch.selectable, all, here)).eq(0);
    const Values log_all = torch::log_softmax(out.actions.masked_fill(impossible, -1e9F), 1);
    const Values action = part(learning::view(batch.action, {all}, here)).unsqueeze(1);
    const Values log_now = log_all.gather(1, action).squeeze(1);
    const Values advantage = column(batch.advantage);
    const Values ratio = (log_now - column(batch.log_probability)).exp();
    const Values clipped = ratio.clamp(1.0 - settings.clip, 1.0 + settings.clip);
    const Values gain = torch::minimum(ratio * advantage, clipped * advantage);
    const Values critic = (out.value - column(batch.returns)).square();
    const Values entropy = -(log_all.exp() * log_all.masked_fill(impossible, 0.0F)).sum(1);
    const Values terms = settings.value_coefficient * critic - gain - settings.entropy * entropy;
    const Values loss = (column(batch.weight) * terms).sum() / static_cast<double>(all);
    return {.loss = loss.item<double>(),
            .mean_value = out.value.sum().item<double>() / static_cast<double>(all),
            .gradient = network.gradient_of(loss)};
  }

  PpoLearnerOptions settings;
  torch::Device device;
  TorchNetwork network;
  learning::Adam adam;
  learning::SlicePool pool;
};

PpoLearner::PpoLearner(const ObservationSpec& spec, const NetworkOptions& network,
                       const TensorMap& tensors, const PpoLearnerOptions& options)
    : parts_(std::make_unique<Parts>(spec, network, tensors, options)) {}
PpoLearner::~PpoLearner() = default;

UpdateReport PpoLearner::update(const PpoBatch& batch, const Noise* noise, double learning_rate) {
  Parts& p = *parts_;
  std::optional<TorchNoise> drawn;
  if (noise != nullptr) drawn = learning::to_torch(*noise, p.device);
  const auto rows = static_cast<std::int64_t>(batch.size);
  std::vector<Slice> slices(p.pool.slices(rows));
  p.pool.run(rows, [&](std::size_t slice, std::int64_t first, std::int64_t count) {
    slices[slice] = p.compute(batch, first, count, drawn ? &*drawn : nullptr);
  });
  UpdateReport report;
  Values gradient;
  for (const Slice& slice : slices) {
    report.loss += slice.loss;
    report.mean_q += slice.mean_value;
    gradient = gradient.defined() ? gradient.add_(slice.gradient) : slice.gradient;
  }
  report.gradient_norm =
      p.adam.clipped_step(p.network.flat(), gradient, p.settings.gradient_clip, learning_rate);
  return report;
}

TensorMap PpoLearner::tensors() const {
  const TorchNetwork& network = parts_->network;
  return network.store(network.flat());
}

TensorMap PpoLearner::averaged_tensors() const {
  const TorchNetwork& network = parts_->network;
  return network.store(parts_->adam.averaged(network.flat()));
}

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
