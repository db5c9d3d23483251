#include "linewright/network/noise.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace linewright {
namespace {

// Only +, -, *, /, and square roots, each rounded once: the same bits everywhere, which the
// library's logarithm, sine and cosine do not promise.

/// ln(x) for normal x > 0, absolute error below 3e-7 for x in (0, 1].
float logarithm(float x) {
  // x = m 2^n with m in [sqrt(1/2), sqrt(2)).
  const std::uint32_t bits = std::bit_cast<std::uint32_t>(x);
  const std::uint32_t above = bits - std::bit_cast<std::uint32_t>(0x1.6a09e6p-1F);
  const auto n = static_cast<std::int32_t>(above) >> 23;
  const float m = std::bit_cast<float>(bits - (static_cast<std::uint32_t>(n) << 23U));
  // ln(m) = 2 artanh((m - 1) / (m + 1))
  const float z = (m - 1.0F) / (m + 1.0F);
  const float z2 = z * z;
  const float series = 1.0F + z2 * (1.0F / 3.0F + z2 * (1.0F / 5.0F + z2 * (1.0F / 7.0F)));
  return static_cast<float>(n) * 0x1.62e43p-1F + 2.0F * z * series;
}

struct Direction {
  float cosine;
  float sine;
};

/// The unit vector of the angle `a`, |a| <= pi/4; absolute error below 2e-7.
Direction direction(float a) {
  const float s = a * a;
  const float sine = a * (1.0F - s * (1.0F / 6.0F - s * (1.0F / 120.0F - s * (1.0F / 5040.0F))));
  const float cosine =
      1.0F - s * (0.5F - s * (1.0F / 24.0F - s * (1.0F / 720.0F - s * (1.0F / 40320.0F))));
  return {cosine, sine};
}

float scaled(float e) { return std::copysign(std::sqrt(std::abs(e)), e); }

struct Pair {
  float first;
  float second;
};

/// Two numbers by Box and Muller: 24 bits for the radius, 2 for the quarter of the circle, 24 for
/// the angle within it.
Pair scaled_normal_pair(std::uint64_t random) {
  const auto high = static_cast<std::uint32_t>(random >> 40U);
  const auto low = static_cast<std::uint32_t>(random) & 0xffffffU;
  const auto quarter = static_cast<std::uint32_t>(random >> 24U) & 3U;
  const float share = (static_cast<float>(high) + 1.0F) * 0x1p-24F;  // (0, 1]
  const float radius = std::sqrt(std::max(0.0F, -2.0F * logarithm(share)));
  // (-pi/4, pi/4), without 0 and symmetric
  const float angle = (static_cast<float>(low) - 8388607.5F) * (0x1.921fb6p+0F * 0x1p-24F);
  const Direction at = direction(angle);
  const float x = (quarter & 1U) != 0 ? at.sine : at.cosine;
  const float y = (quarter & 1U) != 0 ? at.cosine : at.sine;
  const float sign = (quarter & 2U) != 0 ? -radius : radius;
  return {scaled(sign * x), scaled(sign * y)};
}

void sample(RandomStream& random, LayerNoise& layer) {
  sample_scaled_normal(random, layer.in);
  sample_scaled_normal(random, layer.out);
}

}  // namespace

void sample_scaled_normal(RandomStream& random, std::vector<float>& values) {
  std::size_t i = 0;
  for (; i + 1 < values.size(); i += 2) {
    const Pair pair = scaled_normal_pair(random.next());
    values[i] = pair.first;
    values[i + 1] = pair.second;
  }
  if (i < values.size()) values[i] = scaled_normal_pair(random.next()).first;
}

void sample_noise(RandomStream& random, Noise& noise) {
  sample(random, noise.advantage_hidden);
  sample(random, noise.advantage_out);
  sample(random, noise.value_hidden);
  sample(random, noise.value_out);
}

}  // namespace linewright
