#pragma once

#include <cstdint>
#include <string_view>

namespace linewright {

inline constexpr std::uint64_t kHashStart = 0xcbf29ce484222325ULL;

/// FNV-1a of the bytes, behind those that `hash` stands for: the same on every platform. Not for
/// keeping secrets.
[[nodiscard]] constexpr std::uint64_t hash_of(std::string_view bytes,
                                              std::uint64_t hash = kHashStart) {
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  return hash;
}

}  // namespace linewright
