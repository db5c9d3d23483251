#pragma once

#include <cstddef>
#include <cstdint>

namespace linewright::learning {

/// Rows of vectors in memory: row i begins at `at + i * stride`.
struct Rows {
  const float* at = nullptr;
  std::size_t stride = 0;
};
struct MutableRows {
  float* at = nullptr;
  std::size_t stride = 0;
};

/// Sizes of one attention: `queries` rows attend to `keys` rows of which `present` says which
/// count.
struct AttentionShape {
  std::size_t queries = 0;
  std::size_t keys = 0;
  std::size_t heads = 1;
  std::size_t head_width = 0;
};

/// Multi-head attention of one sample and its gradients, compiled for one instruction set.
struct AttentionKernels {
  /// out = softmax(q k^T / sqrt(head_width)) v over the present keys (paper, Sec. 3.3.5). Vectors
  /// of all heads lie side by side in a row. `weights` receives the softmax, [heads][queries][keys]
  /// with present keys first, for `backward`. `scratch` holds scratch_size() numbers.
  void (*forward)(const AttentionShape& shape, Rows query, Rows key, Rows value,
                  const std::uint8_t* present, float* weights, MutableRows out, float* scratch);

  /// Gradients with respect to query, key and value (written, not added); those of absent keys
  /// are 0.
  void (*backward)(const AttentionShape& shape, Rows query, Rows key, Rows value,
                   const std::uint8_t* present, const float* weights, Rows out_gradient,
                   MutableRows query_gradient, MutableRows key_gradient, MutableRows value_gradient,
                   float* scratch);
};

/// Numbers of working space that either function needs.
[[nodiscard]] std::size_t scratch_size(const AttentionShape& shape);

/// Those for any machine, and those for some (null when not compiled for such machines).
[[nodiscard]] const AttentionKernels& plain_attention_kernels();
[[nodiscard]] const AttentionKernels* avx2_attention_kernels();
[[nodiscard]] const AttentionKernels* avx512_attention_kernels();

/// The fastest that this machine can run.
[[nodiscard]] const AttentionKernels& attention_kernels();

}  // namespace linewright::learning
