#include "forward_pass.hpp"

#include <algorithm>

namespace linewright::packed {

using kernels::kLanes;
using kernels::padded;
using kernels::Then;

namespace {

/// A score no key reaches.
constexpr float kNoKey = -1e30F;

}  // namespace

void Pass::linear(const Linear& layer, const float* x, std::size_t stride, std::size_t rows,
                  float* y, Then then) const {
  kernels_.multiply({.x = x,
                     .x_stride = stride,
                     .rows = rows,
                     .depth = layer.depth,
                     .w = layer.weight.data(),
                     .w_block = layer.depth * kLanes,
                     .blocks = layer.blocks,
                     .bias = layer.bias.data(),
                     .y = y,
                     .y_stride = layer.blocks * kLanes,
                     .then = then});
}

void Pass::norm(const Norm& layer, const float* x, std::size_t rows) const {
  kernels_.layer_norm(layer.view(), x, sizes_.width, rows, buffers_.normed);
}

void Pass::encode(const float* features, const std::uint8_t* present) {
  rows_ = 0;
  for (const Group& group : weights_.groups) {
    if (group.always_present) tasks_ = rows_;
    if (group.encoder == TokenGroup::Encoder::kOwn) {
      encode_own(group, features, present);
    } else {
      encode_alike(group, features, present);
    }
    for (const std::size_t count : group.features) features += count;
    present += group.features.size();
  }
  const std::size_t keys = padded(rows_);
  std::fill(buffers_.mask, buffers_.mask + rows_, 0.0F);
  std::fill(buffers_.mask + rows_, buffers_.mask + keys, kNoKey);
}

void Pass::encode_alike(const Group& group, const float* features, const std::uint8_t* present) {
  const std::size_t tokens = group.features.size();
  const bool named = group.encoder == TokenGroup::Encoder::kNamed;
  const auto here = [&](std::size_t t) { return group.always_present || present[t] != 0; };
  for (std::size_t first = 0; first < tokens;) {
    std::size_t end = first;
    while (end < tokens && here(end)) ++end;
    if (end == first) {
      ++first;
      continue;
    }
    kernels_.multiply({.x = features + first * group.linear.depth,
                       .x_stride = group.linear.depth,
                       .rows = end - first,
                       .depth = group.linear.depth,
                       .w = group.linear.weight.data(),
                       .w_block = group.linear.depth * kLanes,
                       .blocks = group.linear.blocks,
                       .bias = group.linear.bias.data() + (named ? first * sizes_.width : 0),
                       .bias_stride = named ? sizes_.width : 0,
                       .y = buffers_.x + rows_ * sizes_.width,
                       .y_stride = sizes_.width});
    rows_ += end - first;
    first = end;
  }
}

void Pass::encode_own(const Group& group, const float* features, const std::uint8_t* present) {
  std::size_t offset = 0;
  for (std::size_t t = 0; t < group.features.size(); ++t) {
    const std::size_t count = group.features[t];
    if (group.always_present || present[t] != 0) {
      kernels_.multiply({.x = features + offset,
                         .x_stride = count,
                         .rows = 1,
                         .depth = count,
                         .w = group.linear.weight.data() + offset * kLanes,
                         .w_block = group.linear.depth * kLanes,
                         .blocks = group.linear.blocks,
                         .bias = group.linear.bias.data() + t * sizes_.width,
                         .y = buffers_.x + rows_ * sizes_.width,
                         .y_stride = sizes_.width});
      ++rows_;
    }
    offset += count;
  }
}

void Pass::transpose_keys(const float* k, std::size_t stride) const {
  const std::size_t keys_stride = padded(rows_);
  for (std::size_t c = 0; c < sizes_.per_head; ++c) {
    float* const row = buffers_.keys + c * keys_stride;
    for (std::size_t j = 0; j < rows_; ++j) row[j] = k[j * stride + c];
    std::fill(row + rows_, row + keys_stride, 0.0F);
  }
}

void Pass::attend(const float* q, std::size_t q_stride, std::size_t rows, const float* k,
                  const float* v, std::size_t kv_stride) const {
  const std::size_t keys_stride = padded(rows_);
  const std::size_t head_stride = padded(sizes_.per_head);
  std::fill(buffers_.zeros, buffers_.zeros + head_stride, 0.0F);
  for (std::size_t head = 0; head < sizes_.heads; ++head) {
    const std::size_t at = head * head_stride;
    transpose_keys(k + at, kv_stride);
    kernels_.multiply({.x = q + at,
                       .x_stride = q_stride,
                       .rows = rows,
                       .depth = sizes_.per_head,
                       .w = buffers_.keys,
                       .w_stride = keys_stride,
                       .w_block = kLanes,
                       .blocks = keys_stride / kLanes,
                       .bias = buffers_.mask,
                       .y = buffers_.scores,
                       .y_stride = keys_stride});
    kernels_.softmax(buffers_.scores, keys_stride, rows, keys_stride / kLanes,
                     sizes_.attention_scale);
    kernels_.multiply({.x = buffers_.scores,
                       .x_stride = keys_stride,
                       .rows = rows,
                       .depth = rows_,
                       .w = v + at,
                       .w_stride = kv_stride,
                       .w_block = kLanes,
                       .blocks = head_stride / kLanes,
                       .bias = buffers_.zeros,
                       .y = buffers_.attended + at,
                       .y_stride = sizes_.heads_width});
  }
}

void Pass::add_feedforward(const Norm& before, const Feedforward& layers, float* x,
                           std::size_t rows) const {
  norm(before, x, rows);
  linear(layers.first, buffers_.normed, sizes_.width, rows, buffers_.feedforward, Then::kRelu);
  linear(layers.second, buffers_.feedforward, sizes_.feedforward, rows, x, Then::kAdd);
}

void Pass::run_block(const Block& block) const {
  const std::size_t stride = 3 * sizes_.heads_width;
  norm(block.norm1, buffers_.x, rows_);
  linear(block.qkv, buffers_.normed, sizes_.width, rows_, buffers_.qkv, Then::kStore);
  attend(buffers_.qkv, stride, rows_, buffers_.qkv + sizes_.heads_width,
         buffers_.qkv + 2 * sizes_.heads_width, stride);
  linear(block.out, buffers_.attended, sizes_.heads_width, rows_, buffers_.x, Then::kAdd);
  add_feedforward(block.norm2, block.feedforward, buffers_.x, rows_);
}

void Pass::average(const float* rows, std::size_t count, float* mean) const {
  std::fill(mean, mean + sizes_.width, 0.0F);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t c = 0; c < sizes_.plain_width; ++c) mean[c] += rows[i * sizes_.width + c];
  }
  for (std::size_t c = 0; c < sizes_.plain_width; ++c) mean[c] /= static_cast<float>(count);
}

void Pass::cross() const {
  const Cross& layers = weights_.cross;
  const std::size_t stride = 2 * sizes_.heads_width;
  const float* tasks = buffers_.x + tasks_ * sizes_.width;
  if (sizes_.queries == sizes_.actions) {
    std::copy(tasks, tasks + sizes_.queries * sizes_.width, buffers_.u);
  } else {
    average(tasks, sizes_.actions, buffers_.u);
  }
  norm(layers.norm_memory, buffers_.x, rows_);
  linear(layers.kv, buffers_.normed, sizes_.width, rows_, buffers_.qkv, Then::kStore);
  norm(layers.norm_query, buffers_.u, sizes_.queries);
  linear(layers.query, buffers_.normed, sizes_.width, sizes_.queries, buffers_.queries,
         Then::kStore);
  attend(buffers_.queries, sizes_.heads_width, sizes_.queries, buffers_.qkv,
         buffers_.qkv + sizes_.heads_width, stride);
  linear(layers.out, buffers_.attended, sizes_.heads_width, sizes_.queries, buffers_.u, Then::kAdd);
  add_feedforward(layers.norm_feedforward, layers.feedforward, buffers_.u, sizes_.queries);
  norm(layers.norm_out, buffers_.u, sizes_.queries);
}

void Pass::noisy(const Noisy& layer, const LayerNoise* noise, const float* x, std::size_t stride,
                 std::size_t rows, float* y, Then then) const {
  if (noise == nullptr || layer.sigma.weight.empty()) {
    linear(layer.mean, x, stride, rows, y, then);
    return;
  }
  std::copy(noise->out.begin(), noise->out.end(), buffers_.noise);
  std::fill(buffers_.noise + layer.outputs, buffers_.noise + layer.mean.blocks * kLanes, 0.0F);
  const float one = 1.0F;
  for (std::size_t block = 0; block < layer.mean.blocks; ++block) {
    const std::size_t column = block * kLanes;
    const std::size_t at = column * layer.inputs;
    kernels_.perturb(layer.mean.weight.data() + at, layer.sigma.weight.data() + at,
                     noise->in.data(), buffers_.noise + column, layer.inputs, buffers_.weight + at);
    kernels_.perturb(layer.mean.bias.data() + column, layer.sigma.bias.data() + column, &one,
                     buffers_.noise + column, 1, buffers_.bias + column);
  }
  kernels_.multiply({.x = x,
                     .x_stride = stride,
                     .rows = rows,
                     .depth = layer.inputs,
                     .w = buffers_.weight,
                     .w_block = layer.inputs * kLanes,
                     .blocks = layer.mean.blocks,
                     .bias = buffers_.bias,
                     .y = y,
                     .y_stride = layer.mean.blocks * kLanes,
                     .then = then});
}

void Pass::advantages(const Noise* noise, std::vector<float>& actions) const {
  const LayerNoise* hidden = noise == nullptr ? nullptr : &noise->advantage_hidden;
  const LayerNoise* out = noise == nullptr ? nullptr : &noise->advantage_out;
  noisy(weights_.advantage_hidden, hidden, buffers_.normed, sizes_.width, sizes_.queries,
        buffers_.hidden, Then::kRelu);
  noisy(weights_.advantage_out, out, buffers_.hidden, sizes_.hidden, sizes_.queries,
        buffers_.outputs, Then::kStore);
  actions.resize(sizes_.actions);
  const std::size_t stride = sizes_.queries == 1 ? 1 : sizes_.outputs;
  for (std::size_t i = 0; i < sizes_.actions; ++i) actions[i] = buffers_.outputs[i * stride];
}

float Pass::value(const Noise* noise) const {
  const LayerNoise* hidden = noise == nullptr ? nullptr : &noise->value_hidden;
  const LayerNoise* out = noise == nullptr ? nullptr : &noise->value_out;
  average(buffers_.normed, sizes_.queries, buffers_.mean);
  noisy(weights_.value_hidden, hidden, buffers_.mean, sizes_.width, 1, buffers_.hidden,
        Then::kRelu);
  noisy(weights_.value_out, out, buffers_.hidden, sizes_.hidden, 1, buffers_.outputs, Then::kStore);
  return buffers_.outputs[0];
}

void Pass::run(const float* features, const std::uint8_t* present) {
  encode(features, present);
  for (const Block& block : weights_.blocks) run_block(block);
  cross();
}

}  // namespace linewright::packed
