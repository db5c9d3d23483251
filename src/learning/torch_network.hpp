#pragma once

#include <map>
#include <string>
#include <vector>

#include "attention.hpp"
#include "linewright/network/network.hpp"

namespace linewright::learning {

/// Noise of one forward pass, f(e) of every noisy layer: a row for each sample, or one row for all.
struct TorchNoise {
  struct Layer {
    torch::Tensor in;   ///< [B or 1, in]
    torch::Tensor out;  ///< [B or 1, out]
  };
  Layer advantage_hidden, advantage_out, value_hidden, value_out;

  /// The rows of some samples.
  [[nodiscard]] TorchNoise rows(std::int64_t first, std::int64_t count) const;
};

/// One noise for all samples.
[[nodiscard]] TorchNoise to_torch(const Noise& noise, torch::Device device);

/// Independent noise for each of `samples`. `sizes` is the noise of such a network.
[[nodiscard]] TorchNoise draw_noise(const Noise& sizes, std::size_t samples, RandomStream& random,
                                    torch::Device device);

/// The network of linewright/network/network.hpp in LibTorch, so that it can learn.
class TorchNetwork {
 public:
  struct Output {
    torch::Tensor actions;  ///< [B, A]: Q values or logits
    torch::Tensor value;    ///< [B]; undefined without a value stream
  };

  TorchNetwork(const ObservationSpec& spec, const NetworkOptions& options, const TensorMap& tensors,
               torch::Device device);

  /// `features` [B, F] float, `present` [B, T] uint8, on the network's device.
  [[nodiscard]] Output forward(const torch::Tensor& features, const torch::Tensor& present,
                               const TorchNoise* noise) const;

  /// Every tensor, in order of the names. Leaves that require gradients.
  [[nodiscard]] const std::map<std::string, torch::Tensor>& tensors() const { return tensors_; }
  /// All of them, one behind the other: the memory that they share.
  [[nodiscard]] const torch::Tensor& flat() const { return flat_; }
  /// The gradient of a loss, in the same order. Safe to use from several threads at once.
  [[nodiscard]] torch::Tensor gradient_of(const torch::Tensor& loss) const;
  /// The tensors that a vector like flat() holds.
  [[nodiscard]] TensorMap store(const torch::Tensor& flat) const;
  void load(const TensorMap& tensors);
  /// Throws std::invalid_argument when there are not as many numbers.
  void load_flat(const std::vector<float>& numbers);

 private:
  struct Group {
    std::string name;
    TokenGroup::Encoder encoder = TokenGroup::Encoder::kShared;
    std::int64_t first_feature = 0;
    std::int64_t features = 0;  ///< of all tokens
    std::int64_t tokens = 0;
    std::int64_t most = 0;  ///< features of the largest token
    torch::Tensor padded;   ///< own: [tokens * most], row of each padded feature, or `features`
  };

  void share_memory(const std::vector<TensorShape>& shapes);
  [[nodiscard]] const torch::Tensor& at(const std::string& name) const { return tensors_.at(name); }
  [[nodiscard]] torch::Tensor linear(const torch::Tensor& x, const std::string& name) const;
  [[nodiscard]] torch::Tensor noisy(const torch::Tensor& x, const std::string& name,
                                    const TorchNoise::Layer* noise) const;
  [[nodiscard]] torch::Tensor norm(const torch::Tensor& x, const std::string& name) const;
  [[nodiscard]] torch::Tensor feedforward(const torch::Tensor& x, const std::string& prefix) const;
  [[nodiscard]] torch::Tensor encode(const torch::Tensor& features) const;
  [[nodiscard]] torch::Tensor encode_own(const Group& group, const torch::Tensor& features) const;
  [[nodiscard]] torch::Tensor cross(const torch::Tensor& tokens,
                                    const torch::Tensor& present) const;

  NetworkOptions options_;
  torch::Device device_;
  std::vector<Group> groups_;
  std::int64_t task_token_ = 0;
  std::int64_t actions_ = 0;
  torch::Tensor flat_;
  std::vector<std::string> names_;  ///< in the order of `flat_`
  std::map<std::string, torch::Tensor> tensors_;
};

}  // namespace linewright::learning
