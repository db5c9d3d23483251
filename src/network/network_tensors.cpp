#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <utility>

#include "linewright/base/diagnostic.hpp"
#include "linewright/base/random.hpp"
#include "linewright/network/network.hpp"

namespace linewright {
namespace {

using Encoder = TokenGroup::Encoder;

/// What a tensor is, which decides how it starts.
enum class Role { kWeight, kBranchEnd, kZero, kOne, kSigma };

struct Slot {
  TensorShape tensor;
  Role role = Role::kWeight;
  std::int64_t inputs = 1;
};

/// Lists the tensors in the order of network.hpp.
class Lister {
 public:
  Lister(const ObservationSpec& spec, const NetworkOptions& options)
      : spec_(spec), options_(options) {}

  std::vector<Slot> list() {
    for (const TokenGroup& group : spec_.groups) add_encoder(group);
    for (int layer = 0; layer < options_.encoder_layers; ++layer) add_block(layer);
    add_cross();
    add_heads();
    return std::move(slots_);
  }

 private:
  void add(std::string name, std::vector<std::int64_t> shape, Role role, std::int64_t inputs) {
    slots_.push_back({{std::move(name), std::move(shape)}, role, inputs});
  }

  void add_linear(const std::string& name, std::int64_t in, std::int64_t out, Role role) {
    add(name + ".weight", {in, out}, role, in);
    add(name + ".bias", {out}, Role::kZero, in);
  }

  void add_norm(const std::string& name) {
    add(name + ".weight", {options_.width}, Role::kOne, 1);
    add(name + ".bias", {options_.width}, Role::kZero, 1);
  }

  void add_noisy(const std::string& name, std::int64_t in, std::int64_t out) {
    add_linear(name, in, out, Role::kWeight);
    if (!options_.noisy) return;
    add(name + ".weight_sigma", {in, out}, Role::kSigma, in);
    add(name + ".bias_sigma", {out}, Role::kSigma, in);
  }

  void add_encoder(const TokenGroup& group) {
    if (group.tokens.empty()) return;
    const std::string name = "encoder." + group.name;
    const auto tokens = static_cast<std::int64_t>(group.tokens.size());
    const auto first = static_cast<std::int64_t>(group.features_of(0).size());
    const bool own = group.encoder == Encoder::kOwn;
    const std::int64_t rows = own ? static_cast<std::int64_t>(group.size()) : first;
    const std::int64_t inputs = std::max<std::int64_t>(1, own ? rows / tokens : rows);
    add(name + ".weight", {rows, options_.width}, Role::kWeight, inputs);
    if (group.encoder == Encoder::kShared) {
      add(name + ".bias", {1, options_.width}, Role::kZero, inputs);
    } else {
      add(name + ".bias", {tokens, options_.width}, Role::kWeight, inputs);
    }
  }

  void add_block(int layer) {
    const std::string name = fmt::format("blocks.{}", layer);
    const std::int64_t width = options_.width;
    add_norm(name + ".norm1");
    add_linear(name + ".qkv", width, 3 * width, Role::kWeight);
    add_linear(name + ".out", width, width, Role::kBranchEnd);
    add_norm(name + ".norm2");
    add_linear(name + ".ff1", width, options_.feedforward, Role::kWeight);
    add_linear(name + ".ff2", options_.feedforward, width, Role::kBranchEnd);
  }

  void add_cross() {
    const std::int64_t width = options_.width;
    add_norm("cross.norm_memory");
    add_linear("cross.kv", width, 2 * width, Role::kWeight);
    add_norm("cross.norm_query");
    add_linear("cross.query", width, width, Role::kWeight);
    add_linear("cross.out", width, width, Role::kBranchEnd);
    add_norm("cross.norm_ff");
    add_linear("cross.ff1", width, options_.feedforward, Role::kWeight);
    add_linear("cross.ff2", options_.feedforward, width, Role::kBranchEnd);
    add_norm("cross.norm_out");
  }

  void add_heads() {
    const bool single = options_.query == NetworkOptions::Query::kSingle;
    const auto actions = static_cast<std::int64_t>(spec_.actions.size());
    add_noisy("advantage.hidden", options_.width, options_.head_hidden);
    add_noisy("advantage.out", options_.head_hidden, single ? actions : 1);
    if (!options_.dueling) return;
    add_noisy("value.hidden", options_.width, options_.head_hidden);
    add_noisy("value.out", options_.head_hidden, 1);
  }

  const ObservationSpec& spec_;
  const NetworkOptions& options_;
  std::vector<Slot> slots_;
};

void check_tasks(const ObservationSpec& spec, const std::string& file) {
  const auto is_tasks = [](const TokenGroup& group) { return group.name == "tasks"; };
  const auto tasks = std::find_if(spec.groups.begin(), spec.groups.end(), is_tasks);
  const bool sound = tasks != spec.groups.end() && !spec.actions.empty() &&
                     tasks->tokens.size() == spec.actions.size();
  if (!sound) {
    throw ScenarioError(file, "the observation needs a group 'tasks' with a token for each action",
                        "");
  }
}

Tensor initial_tensor(const Slot& slot, const NetworkOptions& options, std::uint64_t seed) {
  RandomStream random = RandomStream::derive(seed, slot.tensor.name);
  Tensor tensor{slot.tensor.shape, {}};
  std::int64_t size = 1;
  for (const std::int64_t extent : tensor.shape) size *= extent;
  const double scale = 1.0 / std::sqrt(static_cast<double>(slot.inputs));
  const double branches = std::sqrt(2.0 * (options.encoder_layers + 1));
  const auto draw = [&](double bound) {
    return static_cast<float>(bound * (2.0 * random.uniform() - 1.0));
  };
  for (std::int64_t i = 0; i < size; ++i) {
    float value = 0.0F;
    if (slot.role == Role::kWeight) value = draw(scale);
    if (slot.role == Role::kBranchEnd) value = draw(scale / branches);
    if (slot.role == Role::kOne) value = 1.0F;
    if (slot.role == Role::kSigma) value = static_cast<float>(options.sigma0 * scale);
    tensor.values.push_back(value);
  }
  return tensor;
}

std::vector<Slot> slots_of(const ObservationSpec& spec, const NetworkOptions& options) {
  check(options, "network");
  check_tasks(spec, "network");
  return Lister(spec, options).list();
}

}  // namespace

std::vector<TensorShape> expected_tensors(const ObservationSpec& spec,
                                          const NetworkOptions& options) {
  std::vector<TensorShape> shapes;
  for (Slot& slot : slots_of(spec, options)) shapes.push_back(std::move(slot.tensor));
  return shapes;
}

TensorMap initial_tensors(const ObservationSpec& spec, const NetworkOptions& options,
                          std::uint64_t seed) {
  TensorMap tensors;
  for (const Slot& slot : slots_of(spec, options)) {
    tensors[slot.tensor.name] = initial_tensor(slot, options, seed);
  }
  return tensors;
}

}  // namespace linewright
