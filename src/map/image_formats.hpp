#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "linewright/map/image.hpp"

// The readers behind read_image(). Each throws ScenarioError naming `file`.
namespace linewright::map_image {

[[noreturn]] void fail(const std::string& file, const std::string& message, std::string hint);

/// For an image whose data end before its last pixel.
[[noreturn]] void fail_truncated(const std::string& file, std::int64_t width, std::int64_t height);

/// Refuses an image without pixels or with more than a grid may have cells.
void check_size(const std::string& file, std::int64_t width, std::int64_t height);

[[nodiscard]] bool is_pgm(std::string_view bytes);
[[nodiscard]] GrayImage read_pgm(std::string_view bytes, const std::string& file);

[[nodiscard]] bool is_png(std::string_view bytes);
[[nodiscard]] GrayImage read_png(std::string_view bytes, const std::string& file);

}  // namespace linewright::map_image
