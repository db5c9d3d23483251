#include "kernels.hpp"

#include <cmath>
#include <cstdint>

#include "kernel_bodies.hpp"

namespace linewright::kernels {
namespace {

/// Loops of a fixed length, for the compiler to make of them what the machine has. Without fused
/// multiply-add in hardware it calls the library's, which is exact and slow.
struct Plain {
  static constexpr std::size_t kRows = 4;
  static constexpr std::size_t kBlocks = 1;

  float v[kLanes];

  static Plain load(const float* from) {
    Plain a;
    for (std::size_t i = 0; i < kLanes; ++i) a.v[i] = from[i];
    return a;
  }
  static void store(float* to, const Plain& a) {
    for (std::size_t i = 0; i < kLanes; ++i) to[i] = a.v[i];
  }
  static Plain all(float value) {
    Plain a;
    for (float& lane : a.v) lane = value;
    return a;
  }
  static Plain fma(const Plain& a, const Plain& b, Plain c) {
    for (std::size_t i = 0; i < kLanes; ++i) c.v[i] = std::fma(a.v[i], b.v[i], c.v[i]);
    return c;
  }
  static Plain add(Plain a, const Plain& b) {
    for (std::size_t i = 0; i < kLanes; ++i) a.v[i] = a.v[i] + b.v[i];
    return a;
  }
  static Plain sub(Plain a, const Plain& b) {
    for (std::size_t i = 0; i < kLanes; ++i) a.v[i] = a.v[i] - b.v[i];
    return a;
  }
  static Plain mul(Plain a, const Plain& b) {
    for (std::size_t i = 0; i < kLanes; ++i) a.v[i] = a.v[i] * b.v[i];
    return a;
  }
  static Plain max(Plain a, const Plain& b) {
    for (std::size_t i = 0; i < kLanes; ++i) a.v[i] = a.v[i] > b.v[i] ? a.v[i] : b.v[i];
    return a;
  }
  static Plain min(Plain a, const Plain& b) {
    for (std::size_t i = 0; i < kLanes; ++i) a.v[i] = a.v[i] < b.v[i] ? a.v[i] : b.v[i];
    return a;
  }
  /// 2^n, n being the lowest bits of a number near 1.5 * 2^23.
  static Plain power_of_two(Plain a) {
    for (float& lane : a.v) {
      const auto bits = __builtin_bit_cast(std::uint32_t, lane);
      lane = __builtin_bit_cast(float, (bits + 127U) << 23U);
    }
    return a;
  }
  static float fold_sum(Plain a) {
    for (std::size_t half = kLanes / 2; half > 0; half /= 2) {
      for (std::size_t i = 0; i < half; ++i) a.v[i] = a.v[i] + a.v[i + half];
    }
    return a.v[0];
  }
  static float fold_max(Plain a) {
    for (std::size_t half = kLanes / 2; half > 0; half /= 2) {
      for (std::size_t i = 0; i < half; ++i) {
        a.v[i] = a.v[i] > a.v[i + half] ? a.v[i] : a.v[i + half];
      }
    }
    return a.v[0];
  }
  static float root(float a) { return std::sqrt(a); }
};

constexpr Kernels kPlain = kernels_with<Plain>("plain");

bool can_run_avx2() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0;
#else
  return false;
#endif
}

bool can_run_avx512() {
#if defined(__x86_64__)
  return can_run_avx2() && __builtin_cpu_supports("avx512f") != 0 &&
         __builtin_cpu_supports("avx512dq") != 0;
#else
  return false;
#endif
}

KernelSets find_sets() {
  KernelSets found;
  std::size_t count = 0;
  if (avx512_kernels() != nullptr && can_run_avx512()) found.sets[count++] = avx512_kernels();
  if (avx2_kernels() != nullptr && can_run_avx2()) found.sets[count++] = avx2_kernels();
  found.sets[count] = &plain_kernels();
  return found;
}

}  // namespace

const Kernels& plain_kernels() { return kPlain; }

const KernelSets& available_kernels() {
  static const KernelSets kSets = find_sets();
  return kSets;
}

}  // namespace linewright::kernels
