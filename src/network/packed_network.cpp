#include "packed_network.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "linewright/base/diagnostic.hpp"
#include "linewright/network/network.hpp"

namespace linewright::packed {
namespace {

using kernels::kLanes;
using kernels::padded;

/// Where each row or column of a tensor goes.
using Places = std::vector<std::size_t>;

/// One after the other.
Places in_order(std::size_t count) {
  Places places(count);
  std::iota(places.begin(), places.end(), std::size_t{0});
  return places;
}

class Packer {
 public:
  Packer(const ObservationSpec& spec, const NetworkOptions& options, const TensorMap& tensors)
      : spec_(spec),
        tensors_(tensors),
        noisy_(options.noisy),
        width_(static_cast<std::size_t>(options.width)),
        heads_(static_cast<std::size_t>(options.heads)),
        feedforward_(static_cast<std::size_t>(options.feedforward)),
        layers_(static_cast<std::size_t>(options.encoder_layers)),
        dueling_(options.dueling) {}

  [[nodiscard]] Weights pack() const {
    Weights weights;
    for (const TokenGroup& group : spec_.groups) weights.groups.push_back(group_of(group));
    for (std::size_t i = 0; i < layers_; ++i) {
      weights.blocks.push_back(block_of(fmt::format("blocks.{}", i)));
    }
    weights.cross = cross_of();
    weights.advantage_hidden = noisy_of("advantage.hidden");
    weights.advantage_out = noisy_of("advantage.out");
    if (dueling_) {
      weights.value_hidden = noisy_of("value.hidden");
      weights.value_out = noisy_of("value.out");
    }
    return weights;
  }

 private:
  [[nodiscard]] const Tensor& tensor(const std::string& name) const { return tensors_.at(name); }

  /// `sections` times the width, each head on whole blocks.
  [[nodiscard]] Places by_heads(std::size_t sections) const {
    const std::size_t per_head = width_ / heads_;
    Places places;
    for (std::size_t head = 0; head < sections * heads_; ++head) {
      for (std::size_t i = 0; i < per_head; ++i) places.push_back(head * padded(per_head) + i);
    }
    return places;
  }

  static Floats packed_weight(const Tensor& from, const Places& rows, const Places& columns,
                              std::size_t depth, std::size_t blocks) {
    Floats to(depth * blocks * kLanes, 0.0F);
    for (std::size_t r = 0; r < rows.size(); ++r) {
      for (std::size_t c = 0; c < columns.size(); ++c) {
        const std::size_t block = columns[c] / kLanes;
        to[(block * depth + rows[r]) * kLanes + columns[c] % kLanes] =
            from.values[r * columns.size() + c];
      }
    }
    return to;
  }

  static Floats packed_rows(const Tensor& from, const Places& columns, std::size_t blocks) {
    const std::size_t rows = from.values.size() / columns.size();
    Floats to(rows * blocks * kLanes, 0.0F);
    for (std::size_t r = 0; r < rows; ++r) {
      for (std::size_t c = 0; c < columns.size(); ++c) {
        to[r * blocks * kLanes + columns[c]] = from.values[r * columns.size() + c];
      }
    }
    return to;
  }

  [[nodiscard]] Linear linear(const std::string& weight, const std::string& bias,
                              const Places& rows, const Places& columns) const {
    Linear result;
    result.depth = rows.empty() ? 0 : rows.back() + 1;
    result.blocks = padded(columns.back() + 1) / kLanes;
    result.weight = packed_weight(tensor(weight), rows, columns, result.depth, result.blocks);
    result.bias = packed_rows(tensor(bias), columns, result.blocks);
    return result;
  }

  [[nodiscard]] Linear linear(const std::string& name, const Places& rows,
                              const Places& columns) const {
    return linear(name + ".weight", name + ".bias", rows, columns);
  }

  [[nodiscard]] Norm norm(const std::string& name) const {
    const Places places = in_order(width_);
    const std::size_t blocks = padded(width_) / kLanes;
    return {width_, packed_rows(tensor(name + ".weight"), places, blocks),
            packed_rows(tensor(name + ".bias"), places, blocks)};
  }

  [[nodiscard]] Feedforward feedforward_of(const std::string& name) const {
    const Places outer = in_order(width_);
    const Places inner = in_order(feedforward_);
    return {linear(name + ".ff1", outer, inner), linear(name + ".ff2", inner, outer)};
  }

  [[nodiscard]] Group group_of(const TokenGroup& group) const {
    Group result;
    result.encoder = group.encoder;
    result.always_present = group.name == "tasks";
    if (group.tokens.empty()) return result;
    for (std::size_t t = 0; t < group.tokens.size(); ++t) {
      result.features.push_back(group.features_of(t).size());
    }
    const std::string name = "encoder." + group.name;
    const auto rows = static_cast<std::size_t>(tensor(name + ".weight").shape.front());
    result.linear = linear(name, in_order(rows), in_order(width_));
    return result;
  }

  [[nodiscard]] Block block_of(const std::string& name) const {
    return {.norm1 = norm(name + ".norm1"),
            .qkv = linear(name + ".qkv", in_order(width_), by_heads(3)),
            .out = linear(name + ".out", by_heads(1), in_order(width_)),
            .norm2 = norm(name + ".norm2"),
            .feedforward = feedforward_of(name)};
  }

  [[nodiscard]] Cross cross_of() const {
    return {.norm_memory = norm("cross.norm_memory"),
            .kv = linear("cross.kv", in_order(width_), by_heads(2)),
            .norm_query = norm("cross.norm_query"),
            .query = linear("cross.query", in_order(width_), by_heads(1)),
            .out = linear("cross.out", by_heads(1), in_order(width_)),
            .norm_feedforward = norm("cross.norm_ff"),
            .feedforward = feedforward_of("cross"),
            .norm_out = norm("cross.norm_out")};
  }

  [[nodiscard]] Noisy noisy_of(const std::string& name) const {
    const auto& shape = tensor(name + ".weight").shape;
    Noisy result;
    result.inputs = static_cast<std::size_t>(shape[0]);
    result.outputs = static_cast<std::size_t>(shape[1]);
    const Places rows = in_order(result.inputs);
    const Places columns = in_order(result.outputs);
    result.mean = linear(name, rows, columns);
    if (noisy_) {
      result.sigma = linear(name + ".weight_sigma", name + ".bias_sigma", rows, columns);
    }
    return result;
  }

  const ObservationSpec& spec_;
  const TensorMap& tensors_;
  bool noisy_;
  std::size_t width_;
  std::size_t heads_;
  std::size_t feedforward_;
  std::size_t layers_;
  bool dueling_;
};

std::size_t size_of(const std::vector<std::int64_t>& shape) {
  std::size_t size = 1;
  for (const std::int64_t extent : shape) size *= static_cast<std::size_t>(extent);
  return size;
}

Diagnostic complaint(const std::string& file, std::string message) {
  return {.severity = Diagnostic::Severity::kError,
          .file = file,
          .line = 0,
          .column = 0,
          .message = std::move(message),
          .hint = ""};
}

}  // namespace

Weights pack(const ObservationSpec& spec, const NetworkOptions& options, const TensorMap& tensors) {
  return Packer(spec, options, tensors).pack();
}

void check_tensors(const ObservationSpec& spec, const NetworkOptions& options,
                   const TensorMap& tensors, const std::string& file) {
  std::vector<Diagnostic> found;
  TensorMap extra = tensors;
  for (const TensorShape& wanted : expected_tensors(spec, options)) {
    const auto tensor = tensors.find(wanted.name);
    extra.erase(wanted.name);
    if (tensor == tensors.end()) {
      found.push_back(
          complaint(file, fmt::format("the tensor {} {} is missing", in_quotes(wanted.name),
                                      shape_text(wanted.shape))));
    } else if (tensor->second.shape != wanted.shape) {
      found.push_back(
          complaint(file, fmt::format("the tensor {} is {}: it must be {}", in_quotes(wanted.name),
                                      shape_text(tensor->second.shape), shape_text(wanted.shape))));
    } else if (tensor->second.values.size() != size_of(wanted.shape)) {
      found.push_back(
          complaint(file, fmt::format("the tensor {} {} has {} numbers", in_quotes(wanted.name),
                                      shape_text(wanted.shape), tensor->second.values.size())));
    }
  }
  for (const auto& [name, tensor] : extra) {
    found.push_back(
        complaint(file, fmt::format("the tensor {} {} belongs to no part of the network",
                                    in_quotes(name), shape_text(tensor.shape))));
  }
  if (found.empty()) return;
  found.back().hint = "the weights belong to another line or to other options";
  throw ScenarioError(std::move(found));
}

}  // namespace linewright::packed
