// The first byte chooses what the others are: an image, a map's YAML file with a small sound image,
// or a YAML file and, behind the first zero byte, its image. They are read, or a ScenarioError
// comes out.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>

#include "linewright/base/diagnostic.hpp"
#include "linewright/map/image.hpp"
#include "linewright/map/map_file.hpp"

namespace {

void check(bool holds) {
  if (!holds) std::abort();
}

void read_as_image(std::string_view bytes) {
  const linewright::GrayImage image = linewright::read_image(bytes, "fuzz.png");
  check(image.width > 0 && image.height > 0);
  const auto pixels =
      static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  check(image.shade.size() == pixels);
  check(image.alpha.empty() || image.alpha.size() == pixels);
}

void read_as_map(std::string_view yaml, std::string_view image) {
  using namespace linewright;
  static_cast<void>(looks_like_map_file(yaml));
  const MapFile map = read_map_text(yaml, "fuzz.yaml", [&](const std::string&, std::string&) {
    return std::optional<std::string>(image);
  });
  // Points wherever the file puts its grid must be safe to ask for.
  const GridFrame& frame = map.grid.frame();
  check(map.grid.size() == frame.size());
  static_cast<void>(map.grid.blocked(frame.cell_at({0.0, 0.0})));
  static_cast<void>(map.grid.blocked(frame.cell_at(frame.center({0, 0}))));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view rest(reinterpret_cast<const char*>(data) + 1, size - 1);
  try {
    if (data[0] == 'i') {
      read_as_image(rest);
    } else if (data[0] == 'y') {
      read_as_map(rest, "P2 3 2 255 0 128 255 254 205 0");
    } else {
      const std::size_t zero = rest.find('\0');
      if (zero != std::string_view::npos) read_as_map(rest.substr(0, zero), rest.substr(zero + 1));
    }
  } catch (const linewright::ScenarioError&) {
  }
  return 0;
}
