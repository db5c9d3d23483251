#include "attention_kernel.hpp"

#if defined(__AVX2__) && defined(__FMA__)

#include "attention_bodies.hpp"

namespace linewright::learning {
const AttentionKernels* avx2_attention_kernels() { return &kKernels; }
}  // namespace linewright::learning

#else

namespace linewright::learning {
const AttentionKernels* avx2_attention_kernels() { return nullptr; }
}  // namespace linewright::learning

#endif
