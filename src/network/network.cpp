#include "linewright/network/network.hpp"

#include <algorithm>
#include <cassert>

#include "forward_pass.hpp"
#include "kernels.hpp"
#include "packed_network.hpp"

namespace linewright {

struct Network::Parts {
  packed::Sizes sizes;
  packed::Weights weights;
  std::size_t memory = 0;  ///< floats of a workspace
  bool dueling = true;
  bool actor_critic = false;
};

namespace {

/// Advantages become Q values.
void add_value(NetworkOutput& output) {
  float mean = 0.0F;
  for (const float advantage : output.actions) mean += advantage;
  mean /= static_cast<float>(output.actions.size());
  for (float& action : output.actions) action = output.value + (action - mean);
}

}  // namespace

Network::Network(const ObservationSpec& spec, const NetworkOptions& options,
                 const TensorMap& tensors, const std::string& file) {
  check(options, file);
  packed::check_tensors(spec, options, tensors, file);
  const packed::Sizes sizes(spec, options);
  parts_ = std::make_shared<const Parts>(Parts{.sizes = sizes,
                                               .weights = packed::pack(spec, options, tensors),
                                               .memory = packed::Buffers::size(sizes),
                                               .dueling = options.dueling,
                                               .actor_critic = options.actor_critic});
}

void Network::forward(const float* features, const std::uint8_t* present, Workspace& workspace,
                      const Noise* noise, NetworkOutput& output) const {
  constexpr std::size_t kCacheLine = 64;
  constexpr std::size_t kSlack = kCacheLine / sizeof(float);
  auto& memory = workspace.memory_;
  if (memory.size() < parts_->memory + kSlack) memory.assign(parts_->memory + kSlack, 0.0F);
  const auto address = reinterpret_cast<std::uintptr_t>(memory.data());
  const std::size_t skipped = (kCacheLine - address % kCacheLine) % kCacheLine / sizeof(float);
  packed::Pass pass(parts_->sizes, parts_->weights,
                    *kernels::available_kernels().sets[instructions_],
                    packed::Buffers(parts_->sizes, memory.data() + skipped));
  pass.run(features, present);
  pass.advantages(noise, output.actions);
  output.value = parts_->dueling ? pass.value(noise) : 0.0F;
  if (parts_->dueling && !parts_->actor_critic) add_value(output);
}

Noise Network::make_noise() const {
  const auto layer = [](const packed::Noisy& of) {
    LayerNoise noise;
    if (of.sigma.weight.empty()) return noise;
    noise.in.assign(of.inputs, 0.0F);
    noise.out.assign(of.outputs, 0.0F);
    return noise;
  };
  const packed::Weights& weights = parts_->weights;
  return {layer(weights.advantage_hidden), layer(weights.advantage_out),
          layer(weights.value_hidden), layer(weights.value_out)};
}

std::vector<std::string> Network::instruction_sets() {
  std::vector<std::string> names;
  for (const kernels::Kernels* set : kernels::available_kernels().sets) {
    if (set != nullptr) names.emplace_back(set->name);
  }
  return names;
}

void Network::use_instructions(const std::string& name) {
  const std::vector<std::string> names = instruction_sets();
  const auto found = std::find(names.begin(), names.end(), name);
  assert(found != names.end());
  if (found != names.end()) instructions_ = static_cast<std::size_t>(found - names.begin());
}

}  // namespace linewright
