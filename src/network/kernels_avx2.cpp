#include "kernels.hpp"

#if defined(__AVX2__) && defined(__FMA__)

#include <immintrin.h>

#include "kernel_bodies.hpp"

namespace linewright::kernels {
namespace {

struct Avx2 {
  static constexpr std::size_t kRows = 6;
  static constexpr std::size_t kBlocks = 1;

  __m256 low;
  __m256 high;

  [[gnu::always_inline]] static inline Avx2 load(const float* from) {
    return {_mm256_loadu_ps(from), _mm256_loadu_ps(from + 8)};
  }
  [[gnu::always_inline]] static inline void store(float* to, Avx2 a) {
    _mm256_storeu_ps(to, a.low);
    _mm256_storeu_ps(to + 8, a.high);
  }
  [[gnu::always_inline]] static inline Avx2 all(float a) {
    const __m256 v = _mm256_set1_ps(a);
    return {v, v};
  }
  [[gnu::always_inline]] static inline Avx2 fma(Avx2 a, Avx2 b, Avx2 c) {
    return {_mm256_fmadd_ps(a.low, b.low, c.low), _mm256_fmadd_ps(a.high, b.high, c.high)};
  }
  [[gnu::always_inline]] static inline Avx2 add(Avx2 a, Avx2 b) {
    return {_mm256_add_ps(a.low, b.low), _mm256_add_ps(a.high, b.high)};
  }
  [[gnu::always_inline]] static inline Avx2 sub(Avx2 a, Avx2 b) {
    return {_mm256_sub_ps(a.low, b.low), _mm256_sub_ps(a.high, b.high)};
  }
  [[gnu::always_inline]] static inline Avx2 mul(Avx2 a, Avx2 b) {
    return {_mm256_mul_ps(a.low, b.low), _mm256_mul_ps(a.high, b.high)};
  }
  /// a > b ? a : b, also for values that are not numbers.
  [[gnu::always_inline]] static inline Avx2 max(Avx2 a, Avx2 b) {
    return {_mm256_max_ps(a.low, b.low), _mm256_max_ps(a.high, b.high)};
  }
  /// a < b ? a : b
  [[gnu::always_inline]] static inline Avx2 min(Avx2 a, Avx2 b) {
    return {_mm256_min_ps(a.low, b.low), _mm256_min_ps(a.high, b.high)};
  }
  /// 2^n, n being the lowest bits of a number near 1.5 * 2^23.
  [[gnu::always_inline]] static inline Avx2 power_of_two(Avx2 a) {
    return {half_power(a.low), half_power(a.high)};
  }
  [[gnu::always_inline]] static inline __m256 half_power(__m256 a) {
    const __m256i n = _mm256_add_epi32(_mm256_castps_si256(a), _mm256_set1_epi32(127));
    return _mm256_castsi256_ps(_mm256_slli_epi32(n, 23));
  }
  [[gnu::always_inline]] static inline float fold_sum(Avx2 a) {
    const __m256 by8 = _mm256_add_ps(a.low, a.high);
    const __m128 by4 = _mm_add_ps(_mm256_castps256_ps128(by8), _mm256_extractf128_ps(by8, 1));
    const __m128 by2 = _mm_add_ps(by4, _mm_movehl_ps(by4, by4));
    return _mm_cvtss_f32(_mm_add_ss(by2, _mm_shuffle_ps(by2, by2, 1)));
  }
  [[gnu::always_inline]] static inline float fold_max(Avx2 a) {
    const __m256 by8 = _mm256_max_ps(a.low, a.high);
    const __m128 by4 = _mm_max_ps(_mm256_castps256_ps128(by8), _mm256_extractf128_ps(by8, 1));
    const __m128 by2 = _mm_max_ps(by4, _mm_movehl_ps(by4, by4));
    return _mm_cvtss_f32(_mm_max_ss(by2, _mm_shuffle_ps(by2, by2, 1)));
  }
  [[gnu::always_inline]] static inline float root(float a) {
    return _mm_cvtss_f32(_mm_sqrt_ss(_mm_set_ss(a)));
  }
};

constexpr Kernels kKernels = kernels_with<Avx2>("avx2");

}  // namespace

const Kernels* avx2_kernels() { return &kKernels; }

}  // namespace linewright::kernels

#else

namespace linewright::kernels {
const Kernels* avx2_kernels() { return nullptr; }
}  // namespace linewright::kernels

#endif
