#include "torch_network.hpp"

#include <gtest/gtest.h>

#include "duct_line.hpp"
#include "torch_values.hpp"

namespace linewright::learning {
namespace {

using Values = torch::Tensor;

const SeenStates& duct_states() {
  static const SeenStates kStates =
      random_states(LINEWRIGHT_SOURCE_DIR "/scenarios/duct_line.yaml", 10'000, 1);
  return kStates;
}

NetworkOptions small(bool dueling, bool single, bool actor_critic) {
  NetworkOptions options{.width = 32, .heads = 2, .feedforward = 48, .head_hidden = 24};
  options.query = single ? NetworkOptions::Query::kSingle : NetworkOptions::Query::kPerTask;
  options.dueling = dueling;
  options.actor_critic = actor_critic;
  return options;
}

/// The largest difference between LibTorch and the plain network over the first `count` states.
double largest_difference(const NetworkOptions& options, std::size_t count, bool with_noise) {
  const SeenStates& states = duct_states();
  const TensorMap tensors = initial_tensors(states.spec, options, 5);
  const Network plain(states.spec, options, tensors);
  const TorchNetwork learned(states.spec, options, tensors, torch::kCPU);
  Noise noise = plain.make_noise();
  RandomStream random(3);
  if (with_noise) sample_noise(random, noise);
  const TorchNoise torch_noise = to_torch(noise, torch::kCPU);
  const auto rows = static_cast<std::int64_t>(states.count);
  const torch::NoGradGuard no_gradient;
  const auto out = learned.forward(
      rows_of(states.features, rows, torch::kCPU).narrow(0, 0, static_cast<std::int64_t>(count)),
      rows_of(states.present, rows, torch::kCPU).narrow(0, 0, static_cast<std::int64_t>(count)),
      with_noise ? &torch_noise : nullptr);
  Workspace workspace;
  NetworkOutput here;
  double largest = 0.0;
  const std::size_t actions = states.spec.actions.size();
  for (std::size_t i = 0; i < count; ++i) {
    plain.forward(states.features.data() + i * states.spec.feature_count(),
                  states.present.data() + i * states.spec.token_count(), workspace,
                  with_noise ? &noise : nullptr, here);
    const float* there = out.actions.data_ptr<float>() + i * actions;
    for (std::size_t a = 0; a < actions; ++a) {
      largest = std::max(largest, std::abs(double(there[a]) - double(here.actions[a])));
    }
    if (options.actor_critic) {
      const float value = out.value.data_ptr<float>()[i];
      largest = std::max(largest, std::abs(double(value) - double(here.value)));
    }
  }
  return largest;
}

TEST(TorchNetwork, OfTheDefaultSizeEqualsThePlainOneOnTenThousandStates) {
  EXPECT_LT(largest_difference({}, 10'000, false), 1e-4);
}

TEST(TorchNetwork, OfEveryKindEqualsThePlainOneWithNoise) {
  for (const bool single : {false, true}) {
    EXPECT_LT(largest_difference(small(true, single, false), 500, true), 1e-4);
    EXPECT_LT(largest_difference(small(false, single, false), 500, true), 1e-4);
    EXPECT_LT(largest_difference(small(true, single, true), 500, true), 1e-4);
  }
  NetworkOptions deep = small(true, false, false);
  deep.encoder_layers = 2;
  EXPECT_LT(largest_difference(deep, 500, true), 1e-4);
  deep.encoder_layers = 0;
  deep.noisy = false;
  EXPECT_LT(largest_difference(deep, 500, false), 1e-4);
}

TEST(TorchNetwork, HasTheGradientThatDifferencesShow) {
  const SeenStates& states = duct_states();
  const NetworkOptions options = small(true, false, false);
  TorchNetwork network(states.spec, options, initial_tensors(states.spec, options, 2), torch::kCPU);
  const Values features = rows_of(states.features, 10'000, torch::kCPU).narrow(0, 100, 32);
  const Values present = rows_of(states.present, 10'000, torch::kCPU).narrow(0, 100, 32);
  Noise noise = Network(states.spec, options, network.store(network.flat())).make_noise();
  RandomStream random(3);
  sample_noise(random, noise);
  const TorchNoise torch_noise = to_torch(noise, torch::kCPU);
  const auto loss = [&] {
    return network.forward(features, present, &torch_noise).actions.square().mean();
  };
  const Values gradient = network.gradient_of(loss());
  torch::manual_seed(1);
  for (int i = 0; i < 5; ++i) {
    const torch::NoGradGuard no_gradient;
    // Along the gradient mostly, so that the difference stands out of the rounding.
    const Values direction =
        gradient / gradient.norm() +
        0.5 * torch::randn_like(gradient) / std::sqrt(static_cast<double>(gradient.numel()));
    constexpr double kStep = 2e-3;
    Values flat = network.flat();
    flat.add_(direction, kStep);
    const auto above = loss().item<double>();
    flat.add_(direction, -2 * kStep);
    const auto below = loss().item<double>();
    flat.add_(direction, kStep);
    const auto expected = (gradient * direction).sum().item<double>();
    EXPECT_NEAR((above - below) / (2 * kStep), expected, 0.02 * std::abs(expected));
  }
}

TEST(TorchNetwork, KeepsItsTensors) {
  const NetworkOptions options = small(true, false, false);
  const TensorMap tensors = initial_tensors(duct_states().spec, options, 9);
  const TorchNetwork network(duct_states().spec, options, tensors, torch::kCPU);
  EXPECT_EQ(network.store(network.flat()), tensors);
}

}  // namespace
}  // namespace linewright::learning
