#include "attention_kernel.hpp"

#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__FMA__)

#include "attention_bodies.hpp"

namespace linewright::learning {
const AttentionKernels* avx512_attention_kernels() { return &kKernels; }
}  // namespace linewright::learning

#else

namespace linewright::learning {
const AttentionKernels* avx512_attention_kernels() { return nullptr; }
}  // namespace linewright::learning

#endif
