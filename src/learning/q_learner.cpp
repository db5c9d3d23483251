#include "linewright/learning/q_learner.hpp"

#include <limits>

#include "adam.hpp"
#include "slices.hpp"
#include "torch_network.hpp"
#include "torch_values.hpp"

namespace linewright {

using learning::Adam;
using learning::TorchNetwork;
using learning::TorchNoise;
using Values = torch::Tensor;

namespace {

/// Rows of a batch as tensors that look into its memory.
struct BatchTensors {
  Values features, present, action, returns, to_end, discount, next_features, next_present,
      next_selectable, weight;
};

BatchTensors tensors_of(const ReplayBatch& batch, std::int64_t first, std::int64_t rows,
                        torch::Device device) {
  const auto all = static_cast<std::int64_t>(batch.size);
  const auto part = [&](const Values& values) { return values.narrow(0, first, rows).to(device); };
  const torch::Device here(torch::kCPU);
  return {part(learning::rows_of(batch.features, all, here)),
          part(learning::rows_of(batch.present, all, here)),
          part(learning::view(batch.action, {all}, here)),
          part(learning::view(batch.returns, {all}, here)),
          part(learning::view(batch.to_end, {all}, here)),
          part(learning::view(batch.discount, {all}, here)),
          part(learning::rows_of(batch.next_features, all, here)),
          part(learning::rows_of(batch.next_present, all, here)),
          part(learning::rows_of(batch.next_selectable, all, here)),
          part(learning::view(batch.weight, {all}, here))};
}

/// What came out for the rows of a slice.
struct Slice {
  double loss = 0.0;  ///< its part of the mean
  double sum_q = 0.0;
  Values errors;
  Values gradient;
};

/// Noise of the three forward passes of an update.
struct UpdateNoise {
  TorchNoise target, choice, online;

  [[nodiscard]] UpdateNoise rows(std::int64_t first, std::int64_t count) const {
    return {target.rows(first, count), choice.rows(first, count), online.rows(first, count)};
  }
};

}  // namespace

struct QLearner::Parts {
  Parts(const ObservationSpec& spec, const NetworkOptions& network, const TensorMap& tensors,
        const QLearnerOptions& given, std::uint64_t seed)
      : options(given),
        device(learning::default_device()),
        online(spec, network, tensors, device),
        target(spec, network, tensors, device),
        noise(Network(spec, network, tensors).make_noise()),
        random(RandomStream::derive(seed, "learner noise")),
        pool(given.threads) {
    adam.epsilon = options.adam_epsilon;
    adam.average_decay = options.average;
  }

  /// Fresh noise for a forward pass: for every sample its own, or one batch would pull all weights
  /// towards one noise.
  TorchNoise draw(std::size_t samples) {
    return learning::draw_noise(noise, samples, random, device);
  }

  /// r + gamma q_target(s', argmax q(s', .)); without double_q the target network chooses, too.
  [[nodiscard]] Values targets(const BatchTensors& batch, const UpdateNoise& drawn) const {
    const torch::NoGradGuard no_gradient;
    const Values rated =
        target.forward(batch.next_features, batch.next_present, &drawn.target).actions;
    Values choice = rated;
    if (options.double_q) {
      choice = online.forward(batch.next_features, batch.next_present, &drawn.choice).actions;
    }
    const Values masked =
        choice.masked_fill(batch.next_selectable.eq(0), -std::numeric_limits<float>::infinity());
    const Values next = rated.gather(1, masked.argmax(1, true)).squeeze(1);
    const Values bootstrapped = batch.returns + batch.discount * next;
    return options.return_bound ? torch::maximum(bootstrapped, batch.to_end) : bootstrapped;
  }

  /// Loss and gradient of some rows, as their part of a mean over `all` rows.
  [[nodiscard]] Slice compute(const BatchTensors& batch, const UpdateNoise& drawn,
                              std::size_t all) const {
    const Values wanted = targets(batch, drawn);
    const Values q = online.forward(batch.features, batch.present, &drawn.online)
                         .actions.gather(1, batch.action.unsqueeze(1))
                         .squeeze(1);
    const Values error = wanted - q;
    const Values loss = (batch.weight * error * error).sum() / static_cast<double>(all);
    return {.loss = loss.item<double>(),
            .sum_q = q.sum().item<double>(),
            .errors = error.detach(),
            .gradient = online.gradient_of(loss)};
  }

  QLearnerOptions options;
  torch::Device device;
  TorchNetwork online;
  TorchNetwork target;
  Noise noise;
  RandomStream random;
  Adam adam;
  learning::SlicePool pool;
};

QLearner::QLearner(const ObservationSpec& spec, const NetworkOptions& network,
                   const TensorMap& tensors, const QLearnerOptions& options, std::uint64_t seed)
    : parts_(std::make_unique<Parts>(spec, network, tensors, options, seed)) {}
QLearner::~QLearner() = default;

UpdateReport QLearner::update(const ReplayBatch& replayed, double learning_rate,
                              std::vector<float>& td_errors) {
  Parts& p = *parts_;
  const UpdateNoise drawn{.target = p.draw(replayed.size),
                          .choice = p.draw(replayed.size),
                          .online = p.draw(replayed.size)};
  const auto rows = static_cast<std::int64_t>(replayed.size);
  std::vector<Slice> slices(p.pool.slices(rows));
  p.pool.run(rows, [&](std::size_t slice, std::int64_t first, std::int64_t count) {
    slices[slice] = p.compute(tensors_of(replayed, first, count, p.device),
                              drawn.rows(first, count), replayed.size);
  });
  UpdateReport report;
  Values gradient;
  td_errors.clear();
  for (const Slice& slice : slices) {
    report.loss += slice.loss;
    report.mean_q += slice.sum_q / static_cast<double>(replayed.size);
    const std::vector<float> errors = learning::numbers_of(slice.errors);
    td_errors.insert(td_errors.end(), errors.begin(), errors.end());
    gradient = gradient.defined() ? gradient.add_(slice.gradient) : slice.gradient;
  }
  report.gradient_norm =
      p.adam.clipped_step(p.online.flat(), gradient, p.options.gradient_clip, learning_rate);
  return report;
}

void QLearner::copy_target() {
  const torch::NoGradGuard no_gradient;
  Values(parts_->target.flat()).copy_(parts_->online.flat());
}

TensorMap QLearner::tensors() const {
  const TorchNetwork& network = parts_->online;
  return network.store(network.flat());
}

TensorMap QLearner::averaged_tensors() const {
  const TorchNetwork& network = parts_->online;
  return network.store(parts_->adam.averaged(network.flat()));
}

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
