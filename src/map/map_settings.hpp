#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "linewright/base/geometry.hpp"
#include "map_yaml.hpp"

namespace linewright::map_yaml {

/// How pixels become cells; p is the darkness of a pixel, 0 white ... 1 black (`negate`: swapped).
enum class Mode : std::uint8_t {
  kTrinary,  ///< p > occupied_thresh: occupied; p < free_thresh: free; between: unknown
  kScale,    ///< the same, but what is not opaque is unknown, and alpha does not count as a channel
  kRaw,      ///< an 8-bit value of 0 ... 100 is an occupancy in per cent, any other unknown
};

/// The YAML file of a map, checked.
struct MapSettings {
  std::string image;  ///< as written
  Spot image_spot;
  double resolution_m = 0.05;  ///< edge of a pixel
  Pose2 origin;                ///< of the lower left corner of the lower left pixel
  bool negate = false;
  double occupied_thresh = 0.65;
  double free_thresh = 0.196;
  Mode mode = Mode::kTrinary;
};

/// Throws ScenarioError with everything that is wrong.
[[nodiscard]] MapSettings read_settings(std::string_view yaml, const std::string& file);

}  // namespace linewright::map_yaml
