#include "torch_network.hpp"

#include <algorithm>
#include <functional>
#include <numeric>
#include <stdexcept>

namespace linewright::learning {
namespace {

using torch::Tensor;

/// By token and feature: the row of the group's weights, or `total`, where a row of zeros stands.
Tensor padded_rows(const TokenGroup& group, std::int64_t most, std::int64_t total) {
  std::vector<std::int64_t> rows;
  std::int64_t row = 0;
  for (std::size_t t = 0; t < group.tokens.size(); ++t) {
    const auto features = static_cast<std::int64_t>(group.features_of(t).size());
    for (std::int64_t f = 0; f < most; ++f) rows.push_back(f < features ? row + f : total);
    row += features;
  }
  return torch::tensor(rows, torch::kInt64);
}

}  // namespace

TorchNoise to_torch(const Noise& noise, torch::Device device) {
  const auto row = [&](const std::vector<float>& values) {
    return torch::tensor(values, torch::kFloat32).unsqueeze(0).to(device);
  };
  const auto layer = [&](const LayerNoise& from) {
    return TorchNoise::Layer{row(from.in), row(from.out)};
  };
  return {layer(noise.advantage_hidden), layer(noise.advantage_out), layer(noise.value_hidden),
          layer(noise.value_out)};
}

TorchNoise draw_noise(const Noise& sizes, std::size_t samples, RandomStream& random,
                      torch::Device device) {
  const auto rows = [&](std::size_t width) {
    std::vector<float> values(samples * width);
    sample_scaled_normal(random, values);
    return torch::tensor(values, torch::kFloat32)
        .view({static_cast<std::int64_t>(samples), static_cast<std::int64_t>(width)})
        .to(device);
  };
  const auto layer = [&](const LayerNoise& of) {
    const Tensor in = rows(of.in.size());
    return TorchNoise::Layer{in, rows(of.out.size())};
  };
  TorchNoise noise;
  noise.advantage_hidden = layer(sizes.advantage_hidden);
  noise.advantage_out = layer(sizes.advantage_out);
  noise.value_hidden = layer(sizes.value_hidden);
  noise.value_out = layer(sizes.value_out);
  return noise;
}

TorchNoise TorchNoise::rows(std::int64_t first, std::int64_t count) const {
  const auto part = [&](const Layer& layer) {
    return Layer{layer.in.narrow(0, first, count), layer.out.narrow(0, first, count)};
  };
  return {part(advantage_hidden), part(advantage_out), part(value_hidden), part(value_out)};
}

TorchNetwork::TorchNetwork(const ObservationSpec& spec, const NetworkOptions& options,
                           const TensorMap& tensors, torch::Device device)
    : options_(options), device_(device) {
  std::int64_t feature = 0;
  std::int64_t token = 0;
  for (const TokenGroup& from : spec.groups) {
    Group group{.name = from.name,
                .encoder = from.encoder,
                .first_feature = feature,
                .features = static_cast<std::int64_t>(from.size()),
                .tokens = static_cast<std::int64_t>(from.tokens.size())};
    for (std::size_t t = 0; t < from.tokens.size(); ++t) {
      group.most = std::max(group.most, static_cast<std::int64_t>(from.features_of(t).size()));
    }
    group.padded = padded_rows(from, group.most, group.features).to(device);
    if (from.name == "tasks") task_token_ = token;
    feature += group.features;
    token += group.tokens;
    if (group.tokens > 0) groups_.push_back(std::move(group));
  }
  actions_ = static_cast<std::int64_t>(spec.actions.size());
  share_memory(expected_tensors(spec, options));
  load(tensors);
}

void TorchNetwork::share_memory(const std::vector<TensorShape>& shapes) {
  const auto numbers = [](const TensorShape& tensor) {
    return std::accumulate(tensor.shape.begin(), tensor.shape.end(), std::int64_t{1},
                           std::multiplies<>());
  };
  std::int64_t total = 0;
  for (const TensorShape& tensor : shapes) total += numbers(tensor);
  flat_ = torch::zeros({total}, torch::TensorOptions().device(device_));
  std::int64_t from = 0;
  for (const TensorShape& tensor : shapes) {
    tensors_[tensor.name] =
        flat_.narrow(0, from, numbers(tensor)).view(tensor.shape).detach().requires_grad_(true);
    names_.push_back(tensor.name);
    from += numbers(tensor);
  }
}

void TorchNetwork::load(const TensorMap& tensors) {
  const torch::NoGradGuard no_gradient;
  for (auto& [name, tensor] : tensors_) {
    const linewright::Tensor& from = tensors.at(name);
    tensor.copy_(torch::tensor(from.values, torch::kFloat32).view(tensor.sizes()));
  }
}

void TorchNetwork::load_flat(const std::vector<float>& numbers) {
  if (static_cast<std::int64_t>(numbers.size()) != flat_.numel()) {
    throw std::invalid_argument("the state is of another network");
  }
  const torch::NoGradGuard no_gradient;
  flat_.copy_(torch::tensor(numbers, torch::kFloat32));
}

Tensor TorchNetwork::gradient_of(const Tensor& loss) const {
  std::vector<Tensor> leaves;
  for (const std::string& name : names_) leaves.push_back(at(name));
  const auto gradients = torch::autograd::grad({loss}, leaves, {}, /*retain_graph=*/false,
                                               /*create_graph=*/false, /*allow_unused=*/true);
  std::vector<Tensor> parts;
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    parts.push_back(gradients[i].defined() ? gradients[i].reshape({-1})
                                           : torch::zeros({leaves[i].numel()}, flat_.options()));
  }
  return torch::cat(parts);
}

TensorMap TorchNetwork::store(const Tensor& flat) const {
  const Tensor here = flat.detach().cpu().contiguous();
  const float* next = here.data_ptr<float>();
  TensorMap stored;
  for (const std::string& name : names_) {
    const Tensor& tensor = at(name);
    stored[name] = {tensor.sizes().vec(), std::vector<float>(next, next + tensor.numel())};
    next += tensor.numel();
  }
  return stored;
}

Tensor TorchNetwork::linear(const Tensor& x, const std::string& name) const {
  const Tensor& weight = at(name + ".weight");
  const Tensor rows = x.reshape({-1, x.size(-1)});
  std::vector<std::int64_t> shape = x.sizes().vec();
  shape.back() = weight.size(1);
  return torch::addmm(at(name + ".bias"), rows, weight).view(shape);
}

Tensor TorchNetwork::noisy(const Tensor& x, const std::string& name,
                           const TorchNoise::Layer* noise) const {
  if (!options_.noisy || noise == nullptr) return linear(x, name);
  // x (W + S * (n_in^T n_out)) = x W + ((x * n_in) S) * n_out, so that every sample can have its
  // own.
  const bool queries = x.dim() == 3;
  const Tensor in = queries ? noise->in.unsqueeze(1) : noise->in;
  const Tensor out = queries ? noise->out.unsqueeze(1) : noise->out;
  return linear(x, name) +
         (torch::matmul(x * in, at(name + ".weight_sigma")) + at(name + ".bias_sigma")) * out;
}

Tensor TorchNetwork::norm(const Tensor& x, const std::string& name) const {
  return torch::layer_norm(x, {x.size(-1)}, at(name + ".weight"), at(name + ".bias"), 1e-5);
}

Tensor TorchNetwork::feedforward(const Tensor& x, const std::string& prefix) const {
  return linear(torch::relu(linear(x, prefix + "ff1")), prefix + "ff2");
}

Tensor TorchNetwork::encode_own(const Group& group, const Tensor& features) const {
  // One product per token: pad all tokens to the same number of features.
  const Tensor zero_row = torch::zeros({1, options_.width}, features.options());
  const Tensor weight = torch::cat({at("encoder." + group.name + ".weight"), zero_row})
                            .index_select(0, group.padded)
                            .view({group.tokens, group.most, options_.width});
  const Tensor zero_column = torch::zeros({features.size(0), 1}, features.options());
  const Tensor inputs = torch::cat({features, zero_column}, 1)
                            .index_select(1, group.padded)
                            .view({features.size(0), group.tokens, group.most})
                            .transpose(0, 1);
  return torch::bmm(inputs, weight).transpose(0, 1);
}

Tensor TorchNetwork::encode(const Tensor& features) const {
  std::vector<Tensor> parts;
  for (const Group& group : groups_) {
    const Tensor own = features.narrow(1, group.first_feature, group.features);
    const Tensor rows =
        group.encoder == TokenGroup::Encoder::kOwn
            ? encode_own(group, own)
            : torch::matmul(own.reshape({features.size(0), group.tokens, group.most}),
                            at("encoder." + group.name + ".weight"));
    parts.push_back(rows + at("encoder." + group.name + ".bias"));
  }
  return torch::cat(parts, 1);
}

Tensor TorchNetwork::cross(const Tensor& tokens, const Tensor& present) const {
  const Tensor tasks = tokens.narrow(1, task_token_, actions_);
  Tensor queries = options_.query == NetworkOptions::Query::kPerTask ? tasks : tasks.mean(1, true);
  const Tensor memory = linear(norm(tokens, "cross.norm_memory"), "cross.kv");
  const Tensor asked = linear(norm(queries, "cross.norm_query"), "cross.query");
  queries = queries + linear(attention(asked, memory, present, options_.heads), "cross.out");
  queries = queries + feedforward(norm(queries, "cross.norm_ff"), "cross.");
  return norm(queries, "cross.norm_out");
}

TorchNetwork::Output TorchNetwork::forward(const Tensor& features, const Tensor& given_present,
                                           const TorchNoise* noise) const {
  Tensor present = given_present.clone();
  present.narrow(1, task_token_, actions_).fill_(1);
  Tensor x = encode(features);
  for (int l = 0; l < options_.encoder_layers; ++l) {
    const std::string block = "blocks." + std::to_string(l) + ".";
    const Tensor qkv = linear(norm(x, block + "norm1"), block + "qkv");
    x = x + linear(self_attention(qkv, present, options_.heads), block + "out");
    x = x + feedforward(norm(x, block + "norm2"), block);
  }
  const Tensor queries = cross(x, present);
  const auto of = [&](TorchNoise::Layer TorchNoise::*layer) {
    return noise == nullptr ? nullptr : &(noise->*layer);
  };
  const Tensor hidden =
      torch::relu(noisy(queries, "advantage.hidden", of(&TorchNoise::advantage_hidden)));
  const Tensor advantage =
      noisy(hidden, "advantage.out", of(&TorchNoise::advantage_out)).view({x.size(0), actions_});
  if (!options_.dueling) return {advantage, {}};
  const Tensor state = queries.mean(1);
  const Tensor value_hidden =
      torch::relu(noisy(state, "value.hidden", of(&TorchNoise::value_hidden)));
  const Tensor value = noisy(value_hidden, "value.out", of(&TorchNoise::value_out));
  if (options_.actor_critic) return {advantage, value.squeeze(1)};
  return {value + advantage - advantage.mean(1, true), value.squeeze(1)};
}

}  // namespace linewright::learning
