#pragma once

#include <png.h>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace linewright {

/// For tests: a PNG image. `samples` holds one value per channel, row by row; with fewer than eight
/// bits they are packed here. A palette (colours and, as far as given, alphas) makes them indices.
struct TestPng {
  std::int32_t width = 1;
  std::int32_t height = 1;
  int depth = 8;
  int colour_type = PNG_COLOR_TYPE_GRAY;
  bool interlaced = false;
  std::vector<std::uint16_t> samples;
  std::vector<png_color> palette;
  std::vector<png_byte> alphas;

  [[nodiscard]] std::string bytes() const {
    std::string out;
    png_structp png = png_create_write_struct(
        PNG_LIBPNG_VER_STRING, nullptr,
        [](png_structp, png_const_charp text) { throw std::runtime_error(text); }, nullptr);
    png_infop info = png_create_info_struct(png);
    png_set_write_fn(
        png, &out,
        [](png_structp p, png_bytep data, png_size_t size) {
          static_cast<std::string*>(png_get_io_ptr(p))
              ->append(reinterpret_cast<const char*>(data), size);
        },
        nullptr);
    png_set_IHDR(png, info, static_cast<png_uint_32>(width), static_cast<png_uint_32>(height),
                 depth, colour_type, interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (!palette.empty()) png_set_PLTE(png, info, palette.data(), static_cast<int>(palette.size()));
    if (!alphas.empty()) {
      png_set_tRNS(png, info, alphas.data(), static_cast<int>(alphas.size()), nullptr);
    }
    png_write_info(png, info);
    const int passes = png_set_interlace_handling(png);
    if (depth < 8) png_set_packing(png);
    for (int pass = 0; pass < passes; ++pass) {
      for (std::int32_t y = 0; y < height; ++y) png_write_row(png, row(y).data());
    }
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    return out;
  }

 private:
  [[nodiscard]] std::vector<png_byte> row(std::int32_t y) const {
    const std::size_t count = samples.size() / static_cast<std::size_t>(height);
    std::vector<png_byte> result;
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint16_t sample = samples[static_cast<std::size_t>(y) * count + i];
      if (depth == 16) result.push_back(static_cast<png_byte>(sample >> 8));
      result.push_back(static_cast<png_byte>(sample & 0xff));
    }
    return result;
  }
};

/// For tests: an 8-bit P5 image.
inline std::string pgm(int width, int height, const std::vector<std::uint8_t>& pixels) {
  std::string bytes = "P5 " + std::to_string(width) + " " + std::to_string(height) + " 255\n";
  for (const std::uint8_t pixel : pixels) bytes += static_cast<char>(pixel);
  return bytes;
}

}  // namespace linewright
