#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace linewright {

/// The brightness of an image's pixels, row by row, the top row first. 16 bits each: images of 16
/// bits and the mean of three channels keep their place beside a map's thresholds.
struct GrayImage {
  static constexpr std::uint16_t kFull = 65535;

  std::int32_t width = 0;
  std::int32_t height = 0;
  std::vector<std::uint16_t> shade;  ///< 0 black ... kFull white; 8-bit value v is 257 * v
  std::vector<std::uint16_t> alpha;  ///< 0 transparent ... kFull opaque; empty: no alpha channel
};

/// Reads a PGM image (P2 or P5, 1 to 16 bits) or a PNG image (every depth and kind; the shade of a
/// colour is the mean of its channels). `file_name` is only used in messages. Throws ScenarioError
/// when the bytes are not such an image, end early, or hold no pixel or more than kMostGridCells;
/// what an image claims to hold is never allocated before it is known that the bytes can hold it.
[[nodiscard]] GrayImage read_image(std::string_view bytes, const std::string& file_name);

}  // namespace linewright
