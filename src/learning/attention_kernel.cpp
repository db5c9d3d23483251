#include "attention_kernel.hpp"

#include "attention_bodies.hpp"

namespace linewright::learning {
namespace {

const AttentionKernels& fastest() {
#if defined(__x86_64__)
  const bool avx2 = __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0;
  const bool avx512 =
      avx2 && __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512dq") != 0;
  if (avx512 && avx512_attention_kernels() != nullptr) return *avx512_attention_kernels();
  if (avx2 && avx2_attention_kernels() != nullptr) return *avx2_attention_kernels();
#endif
  return kKernels;
}

}  // namespace

std::size_t scratch_size(const AttentionShape& shape) {
  const std::size_t keys = padded(shape.keys);
  const std::size_t head = padded(shape.head_width);
  return 5 * head * keys + 3 * head * shape.queries + 2 * shape.queries * keys;
}

const AttentionKernels& plain_attention_kernels() { return kKernels; }

const AttentionKernels& attention_kernels() {
  static const AttentionKernels& kFastest = fastest();
  return kFastest;
}

}  // namespace linewright::learning
