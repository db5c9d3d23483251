#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace linewright {

/// A seeded stream of random numbers, the same on every platform and compiler (xoshiro256**, seeded
/// through SplitMix64; integers by rejection, so unbiased). Streams with different `name` or
/// `index` are independent: each consumer owns its stream, and what one draws never shifts what
/// another sees.
class RandomStream {
 public:
  explicit RandomStream(std::uint64_t seed);

  /// The stream of consumer `name`, number `index`, under `seed`.
  [[nodiscard]] static RandomStream derive(std::uint64_t seed, std::string_view name,
                                           std::uint64_t index = 0);

  [[nodiscard]] std::uint64_t next();

  /// Uniform in [0, bound). `bound` >= 1.
  [[nodiscard]] std::size_t below(std::size_t bound);

  /// Uniform in [low, high], both included. `low` <= `high`.
  [[nodiscard]] int between(int low, int high);

  /// Uniform in [0, 1) with 53 random bits.
  [[nodiscard]] double uniform();

  /// Where the stream stands, to go on from there later.
  using State = std::array<std::uint64_t, 4>;
  [[nodiscard]] const State& state() const { return state_; }
  void restore(const State& state) { state_ = state; }

 private:
  State state_{};
};

}  // namespace linewright
