#pragma once

#include <ATen/core/ivalue.h>
#include <torch/torch.h>

namespace linewright::learning {

/// Multi-head attention of `query` [B, Q, d] to `memory` [B, T, 2d] (keys, then values), over the
/// tokens that are `present` [B, T] (uint8); [B, Q, d]. On the CPU one fused operation, elsewhere
/// the plain operations of plain_attention; differentiable in both.
[[nodiscard]] torch::Tensor attention(const torch::Tensor& query, const torch::Tensor& memory,
                                      const torch::Tensor& present, std::int64_t heads);

/// The same written with LibTorch's operations.
[[nodiscard]] torch::Tensor plain_attention(const torch::Tensor& query, const torch::Tensor& memory,
                                            const torch::Tensor& present, std::int64_t heads);

/// Self-attention: `qkv` [B, T, 3d] holds queries, keys and values.
[[nodiscard]] torch::Tensor self_attention(const torch::Tensor& qkv, const torch::Tensor& present,
                                           std::int64_t heads);

}  // namespace linewright::learning
