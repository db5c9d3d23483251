#include "kernels.hpp"

#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__FMA__)

#include <immintrin.h>

#include "kernel_bodies.hpp"

namespace linewright::kernels {
namespace {

struct Avx512 {
  static constexpr std::size_t kRows = 8;
  static constexpr std::size_t kBlocks = 2;

  __m512 v;

  [[gnu::always_inline]] static inline Avx512 load(const float* from) {
    return {_mm512_loadu_ps(from)};
  }
  [[gnu::always_inline]] static inline void store(float* to, Avx512 a) {
    _mm512_storeu_ps(to, a.v);
  }
  [[gnu::always_inline]] static inline Avx512 all(float a) { return {_mm512_set1_ps(a)}; }
  [[gnu::always_inline]] static inline Avx512 fma(Avx512 a, Avx512 b, Avx512 c) {
    return {_mm512_fmadd_ps(a.v, b.v, c.v)};
  }
  [[gnu::always_inline]] static inline Avx512 add(Avx512 a, Avx512 b) {
    return {_mm512_add_ps(a.v, b.v)};
  }
  [[gnu::always_inline]] static inline Avx512 sub(Avx512 a, Avx512 b) {
    return {_mm512_sub_ps(a.v, b.v)};
  }
  [[gnu::always_inline]] static inline Avx512 mul(Avx512 a, Avx512 b) {
    return {_mm512_mul_ps(a.v, b.v)};
  }
  /// a > b ? a : b, also for values that are not numbers.
  [[gnu::always_inline]] static inline Avx512 max(Avx512 a, Avx512 b) {
    return {_mm512_max_ps(a.v, b.v)};
  }
  /// a < b ? a : b
  [[gnu::always_inline]] static inline Avx512 min(Avx512 a, Avx512 b) {
    return {_mm512_min_ps(a.v, b.v)};
  }
  /// 2^n, n being the lowest bits of a number near 1.5 * 2^23.
  [[gnu::always_inline]] static inline Avx512 power_of_two(Avx512 a) {
    const __m512i n = _mm512_add_epi32(_mm512_castps_si512(a.v), _mm512_set1_epi32(127));
    return {_mm512_castsi512_ps(_mm512_slli_epi32(n, 23))};
  }
  [[gnu::always_inline]] static inline float fold_sum(Avx512 a) {
    const __m256 by8 = _mm256_add_ps(_mm512_castps512_ps256(a.v), _mm512_extractf32x8_ps(a.v, 1));
    const __m128 by4 = _mm_add_ps(_mm256_castps256_ps128(by8), _mm256_extractf128_ps(by8, 1));
    const __m128 by2 = _mm_add_ps(by4, _mm_movehl_ps(by4, by4));
    return _mm_cvtss_f32(_mm_add_ss(by2, _mm_shuffle_ps(by2, by2, 1)));
  }
  [[gnu::always_inline]] static inline float fold_max(Avx512 a) {
    const __m256 by8 = _mm256_max_ps(_mm512_castps512_ps256(a.v), _mm512_extractf32x8_ps(a.v, 1));
    const __m128 by4 = _mm_max_ps(_mm256_castps256_ps128(by8), _mm256_extractf128_ps(by8, 1));
    const __m128 by2 = _mm_max_ps(by4, _mm_movehl_ps(by4, by4));
    return _mm_cvtss_f32(_mm_max_ss(by2, _mm_shuffle_ps(by2, by2, 1)));
  }
  [[gnu::always_inline]] static inline float root(float a) {
    return _mm_cvtss_f32(_mm_sqrt_ss(_mm_set_ss(a)));
  }
};

constexpr Kernels kKernels = kernels_with<Avx512>("avx512");

}  // namespace

const Kernels* avx512_kernels() { return &kKernels; }

}  // namespace linewright::kernels

#else

namespace linewright::kernels {
const Kernels* avx512_kernels() { return nullptr; }
}  // namespace linewright::kernels

#endif
