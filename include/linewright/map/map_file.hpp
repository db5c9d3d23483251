#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "linewright/map/occupancy_grid.hpp"

namespace linewright {

// Maps in the format of ROS map_server: a YAML file with the pose and the meaning of an image, and
// the image beside it (docs/formats/map.md).

/// A map that was read.
struct MapFile {
  OccupancyGrid grid;
  std::uint64_t content_hash = 0;  ///< of the bytes of both files; the same on every platform
};

/// Reads the YAML file and the image it names. Throws ScenarioError with every diagnostic found,
/// in the YAML file with line and column.
[[nodiscard]] MapFile load_map_file(const std::string& yaml_file);

/// The bytes of the file that `image`, as written in the YAML, stands for; none, and `reason` says
/// why, when there is no such file.
using ImageSource =
    std::function<std::optional<std::string>(const std::string& image, std::string& reason)>;

/// The same from text. `file_name` is only used in diagnostics.
[[nodiscard]] MapFile read_map_text(std::string_view yaml, const std::string& file_name,
                                    const ImageSource& image_source);

/// Writes `yaml_file` and beside it the image, which has the same name and the ending `.pgm`: free
/// 254, occupied 0, unknown 205, which reads back as the same grid. First the image, then the YAML,
/// each of them whole or not at all. Throws ScenarioError when `yaml_file` does not end in `.yaml`
/// or
/// `.yml`, or one of them cannot be written.
void save_map_file(const OccupancyGrid& grid, const std::string& yaml_file);

/// Whether the text looks like the YAML file of a map and not like a scenario: it has the key
/// `image` and no key `schema`. For a message to someone who confused the two.
[[nodiscard]] bool looks_like_map_file(std::string_view yaml);

}  // namespace linewright
