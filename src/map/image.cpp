#include "linewright/map/image.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

#include "image_formats.hpp"
#include "linewright/base/diagnostic.hpp"
#include "linewright/map/occupancy_grid.hpp"

namespace linewright {
namespace map_image {

void fail(const std::string& file, const std::string& message, std::string hint) {
  throw ScenarioError(file, message, std::move(hint));
}

void fail_truncated(const std::string& file, std::int64_t width, std::int64_t height) {
  fail(file, fmt::format("the image ends before the last of its {} x {} pixels", width, height),
       "the file was cut off: copy or write it again");
}

void check_size(const std::string& file, std::int64_t width, std::int64_t height) {
  if (width < 1 || height < 1) {
    fail(file, fmt::format("the image has {} x {} pixels", width, height),
         "a map needs one pixel at least");
  }
  const double cells = static_cast<double>(width) * static_cast<double>(height);
  if (cells <= static_cast<double>(kMostGridCells)) return;
  const double factor = std::ceil(std::sqrt(cells / static_cast<double>(kMostGridCells)));
  fail(file, fmt::format("the image has {} x {} pixels: {}", width, height, too_many_cells(cells)),
       fmt::format("scale the image down and make 'resolution' {:.0f} times as large", factor));
}

}  // namespace map_image

namespace {

/// What else people take for a map, by the first bytes.
std::string kind_of(std::string_view bytes) {
  using namespace std::string_view_literals;
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 10> kKinds = {
      {{"P1"sv, "a bitmap (PBM)"sv},
       {"P3"sv, "a colour image (PPM)"sv},
       {"P4"sv, "a bitmap (PBM)"sv},
       {"P6"sv, "a colour image (PPM)"sv},
       {"P7"sv, "a PAM image"sv},
       {"\xff\xd8\xff"sv, "a JPEG image"sv},
       {"GIF8"sv, "a GIF image"sv},
       {"BM"sv, "a BMP image"sv},
       {"II*\0"sv, "a TIFF image"sv},
       {"RIFF"sv, "a WebP image"sv}}};
  if (bytes.empty()) return "empty";
  for (const auto& [start, kind] : kKinds) {
    if (bytes.starts_with(start)) return std::string(kind);
  }
  return "no image that is known here";
}

}  // namespace

GrayImage read_image(std::string_view bytes, const std::string& file_name) {
  if (map_image::is_pgm(bytes)) return map_image::read_pgm(bytes, file_name);
  if (map_image::is_png(bytes)) return map_image::read_png(bytes, file_name);
  map_image::fail(file_name, fmt::format("the file is {}", kind_of(bytes)),
                  "maps are read from PGM (P2, P5) and PNG images: convert it into one of these");
}

}  // namespace linewright
