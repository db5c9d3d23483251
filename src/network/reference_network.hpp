#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "linewright/network/network.hpp"

// The network in double precision, straight from the mathematics in network.hpp and sharing no code
// with it; to compare with.
namespace linewright::reference {

using Row = std::vector<double>;
using Rows = std::vector<Row>;

class ReferenceNetwork {
 public:
  ReferenceNetwork(const ObservationSpec& spec, const NetworkOptions& options,
                   const TensorMap& tensors)
      : spec_(spec), options_(options), tensors_(tensors) {}

  struct Result {
    Row actions;
    double value = 0.0;
  };

  [[nodiscard]] Result run(const float* features, const std::uint8_t* present,
                           const Noise* noise) const {
    std::vector<std::size_t> tasks;
    Rows x = encode(features, present, tasks);
    for (int l = 0; l < options_.encoder_layers; ++l) block(x, "blocks." + std::to_string(l));
    return heads(cross(x, tasks), noise);
  }

 private:
  [[nodiscard]] const std::vector<float>& values(const std::string& name) const {
    return tensors_.at(name).values;
  }

  [[nodiscard]] Rows encode(const float* features, const std::uint8_t* present,
                            std::vector<std::size_t>& tasks) const {
    Rows x;
    for (const TokenGroup& group : spec_.groups) {
      const bool own = group.encoder == TokenGroup::Encoder::kOwn;
      const bool shared = group.encoder == TokenGroup::Encoder::kShared;
      std::size_t first_row = 0;
      for (std::size_t t = 0; t < group.tokens.size(); ++t) {
        const std::size_t count = group.features_of(t).size();
        if (*present++ != 0 || group.name == "tasks") {
          if (group.name == "tasks") tasks.push_back(x.size());
          x.push_back(encoded(group.name, features, count, first_row, shared ? 0 : t));
        }
        features += count;
        if (own) first_row += count;
      }
    }
    return x;
  }

  [[nodiscard]] Row encoded(const std::string& group, const float* features, std::size_t count,
                            std::size_t first_row, std::size_t bias_row) const {
    const auto& weight = values("encoder." + group + ".weight");
    const auto& bias = values("encoder." + group + ".bias");
    const auto width = static_cast<std::size_t>(options_.width);
    Row x(width);
    for (std::size_t c = 0; c < width; ++c) {
      x[c] = bias[bias_row * width + c];
      for (std::size_t k = 0; k < count; ++k) {
        x[c] += double{features[k]} * weight[(first_row + k) * width + c];
      }
    }
    return x;
  }

  [[nodiscard]] Row linear(const Row& x, const std::string& name,
                           const LayerNoise* noise = nullptr) const {
    const auto& weight = values(name + ".weight");
    const auto& bias = values(name + ".bias");
    Row y(bias.begin(), bias.end());
    for (std::size_t k = 0; k < x.size(); ++k) {
      for (std::size_t c = 0; c < y.size(); ++c) y[c] += x[k] * weight[k * y.size() + c];
    }
    if (noise != nullptr) add_noise(y, x, name, *noise);
    return y;
  }

  void add_noise(Row& y, const Row& x, const std::string& name, const LayerNoise& noise) const {
    const auto& weight_sigma = values(name + ".weight_sigma");
    const auto& bias_sigma = values(name + ".bias_sigma");
    for (std::size_t c = 0; c < y.size(); ++c) {
      y[c] += double{bias_sigma[c]} * noise.out[c];
      for (std::size_t k = 0; k < x.size(); ++k) {
        y[c] += x[k] * weight_sigma[k * y.size() + c] * noise.in[k] * noise.out[c];
      }
    }
  }

  [[nodiscard]] Row norm(const Row& x, const std::string& name) const {
    const auto count = static_cast<double>(x.size());
    double mean = 0.0;
    for (const double value : x) mean += value / count;
    double variance = 0.0;
    for (const double value : x) variance += (value - mean) * (value - mean) / count;
    const auto& weight = values(name + ".weight");
    const auto& bias = values(name + ".bias");
    Row y(x.size());
    for (std::size_t c = 0; c < y.size(); ++c) {
      y[c] = (x[c] - mean) / std::sqrt(variance + 1e-5) * weight[c] + bias[c];
    }
    return y;
  }

  static Row relu(Row x) {
    for (double& value : x) value = std::max(value, 0.0);
    return x;
  }

  static void add(Row& x, const Row& y) {
    for (std::size_t c = 0; c < x.size(); ++c) x[c] += y[c];
  }

  static Row part(const Row& x, std::size_t index, std::size_t width) {
    const auto first = x.begin() + static_cast<std::ptrdiff_t>(index * width);
    return {first, first + static_cast<std::ptrdiff_t>(width)};
  }

  [[nodiscard]] Row attention(const Row& query, const Rows& keys, const Rows& values_of) const {
    const auto width = static_cast<std::size_t>(options_.width);
    const std::size_t per_head = width / static_cast<std::size_t>(options_.heads);
    Row output(width, 0.0);
    for (std::size_t first = 0; first < width; first += per_head) {
      Row shares;
      double sum = 0.0;
      for (const Row& key : keys) {
        double score = 0.0;
        for (std::size_t c = first; c < first + per_head; ++c) score += query[c] * key[c];
        shares.push_back(std::exp(score / std::sqrt(static_cast<double>(per_head))));
        sum += shares.back();
      }
      for (std::size_t j = 0; j < keys.size(); ++j) {
        for (std::size_t c = first; c < first + per_head; ++c) {
          output[c] += shares[j] / sum * values_of[j][c];
        }
      }
    }
    return output;
  }

  void feedforward(Row& x, const Row& normed, const std::string& name) const {
    add(x, linear(relu(linear(normed, name + ".ff1")), name + ".ff2"));
  }

  void block(Rows& x, const std::string& name) const {
    const auto width = static_cast<std::size_t>(options_.width);
    Rows q;
    Rows k;
    Rows v;
    for (const Row& row : x) {
      const Row qkv = linear(norm(row, name + ".norm1"), name + ".qkv");
      q.push_back(part(qkv, 0, width));
      k.push_back(part(qkv, 1, width));
      v.push_back(part(qkv, 2, width));
    }
    for (std::size_t i = 0; i < x.size(); ++i) {
      add(x[i], linear(attention(q[i], k, v), name + ".out"));
      feedforward(x[i], norm(x[i], name + ".norm2"), name);
    }
  }

  static Row mean(const Rows& rows) {
    Row result(rows[0].size(), 0.0);
    for (const Row& row : rows) {
      for (std::size_t c = 0; c < row.size(); ++c) {
        result[c] += row[c] / static_cast<double>(rows.size());
      }
    }
    return result;
  }

  [[nodiscard]] Rows cross(const Rows& x, const std::vector<std::size_t>& tasks) const {
    const auto width = static_cast<std::size_t>(options_.width);
    Rows k;
    Rows v;
    for (const Row& row : x) {
      const Row kv = linear(norm(row, "cross.norm_memory"), "cross.kv");
      k.push_back(part(kv, 0, width));
      v.push_back(part(kv, 1, width));
    }
    Rows u;
    for (const std::size_t task : tasks) u.push_back(x[task]);
    if (options_.query == NetworkOptions::Query::kSingle) u = {mean(u)};
    for (Row& row : u) {
      const Row q = linear(norm(row, "cross.norm_query"), "cross.query");
      add(row, linear(attention(q, k, v), "cross.out"));
      feedforward(row, norm(row, "cross.norm_ff"), "cross");
      row = norm(row, "cross.norm_out");
    }
    return u;
  }

  [[nodiscard]] Result heads(const Rows& u, const Noise* noise) const {
    Result result;
    for (const Row& row : u) {
      const Row hidden =
          relu(linear(row, "advantage.hidden", noise ? &noise->advantage_hidden : nullptr));
      const Row out = linear(hidden, "advantage.out", noise ? &noise->advantage_out : nullptr);
      result.actions.insert(result.actions.end(), out.begin(), out.end());
    }
    if (!options_.dueling) return result;
    const Row hidden =
        relu(linear(mean(u), "value.hidden", noise ? &noise->value_hidden : nullptr));
    result.value = linear(hidden, "value.out", noise ? &noise->value_out : nullptr)[0];
    if (options_.actor_critic) return result;
    double average = 0.0;
    for (const double a : result.actions) average += a / static_cast<double>(result.actions.size());
    for (double& a : result.actions) a = result.value + a - average;
    return result;
  }

  const ObservationSpec& spec_;
  const NetworkOptions& options_;
  const TensorMap& tensors_;
};

}  // namespace linewright::reference
