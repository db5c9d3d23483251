#include "linewright/map/map_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <optional>
#include <utility>

#include "linewright/base/diagnostic.hpp"
#include "linewright/base/files.hpp"
#include "linewright/base/hash.hpp"
#include "linewright/map/image.hpp"
#include "map_settings.hpp"

namespace linewright {
namespace {

using map_yaml::MapSettings;
using map_yaml::Mode;

constexpr std::size_t kMostYamlBytes = map_yaml::kMostBytes;
constexpr std::size_t kMostImageBytes = std::size_t{1} << 28;  // the largest grid as text, and more

// What map_saver writes.
constexpr char kFreePixel = '\xfe';
constexpr char kOccupiedPixel = '\x00';
constexpr char kUnknownPixel = '\xcd';
constexpr double kSavedOccupiedThresh = 0.65;
constexpr double kSavedFreeThresh = 0.196;

CellState by_thresholds(double occupancy, const MapSettings& settings) {
  if (occupancy > settings.occupied_thresh) return CellState::kOccupied;
  if (occupancy < settings.free_thresh) return CellState::kFree;
  return CellState::kUnknown;
}

/// The rules of ROS map_server; where its two generations differ, those of nav2_map_server.
CellState state_of(const GrayImage& image, std::size_t pixel, const MapSettings& settings) {
  constexpr double kFull = GrayImage::kFull;
  double shade = image.shade[pixel];
  if (settings.mode == Mode::kRaw) {
    const double percent = std::round(shade * 255.0 / kFull);
    return percent <= 100.0 ? by_thresholds(percent / 100.0, settings) : CellState::kUnknown;
  }
  if (!image.alpha.empty()) {
    const double alpha = image.alpha[pixel];
    if (settings.mode == Mode::kScale && alpha < kFull) return CellState::kUnknown;
    // In trinary mode map_server has always averaged alpha in as a fourth channel.
    if (settings.mode == Mode::kTrinary) shade = (3.0 * shade + alpha) / 4.0;
  }
  return by_thresholds((settings.negate ? shade : kFull - shade) / kFull, settings);
}

OccupancyGrid grid_of(const GrayImage& image, const MapSettings& settings) {
  OccupancyGrid grid({.origin = settings.origin,
                      .cell_m = settings.resolution_m,
                      .columns = image.width,
                      .rows = image.height});
  std::size_t pixel = 0;
  for (std::int32_t row = image.height - 1; row >= 0; --row) {  // the top row comes first
    for (std::int32_t column = 0; column < image.width; ++column) {
      grid.set({column, row}, state_of(image, pixel++, settings));
    }
  }
  return grid;
}

std::string pgm_of(const OccupancyGrid& grid) {
  std::string bytes =
      fmt::format("P5\n# {} m per pixel\n{} {}\n255\n", grid.cell_m(), grid.columns(), grid.rows());
  bytes.reserve(bytes.size() + grid.size());
  for (std::int32_t row = grid.rows() - 1; row >= 0; --row) {
    for (std::int32_t column = 0; column < grid.columns(); ++column) {
      const CellState state = grid.state({column, row});
      bytes += state == CellState::kFree       ? kFreePixel
               : state == CellState::kOccupied ? kOccupiedPixel
                                               : kUnknownPixel;
    }
  }
  return bytes;
}

/// A YAML scalar for any file name.
std::string scalar(const std::string& text) {
  const auto is_plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.' || c == '-';
  };
  const bool starts_well = !text.empty() && std::isalpha(static_cast<unsigned char>(text[0])) != 0;
  if (starts_well && std::all_of(text.begin(), text.end(), is_plain)) return text;
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? "''" : std::string(1, c);
  return quoted + "'";
}

std::string yaml_of(const OccupancyGrid& grid, const std::string& image) {
  const Pose2& origin = grid.frame().origin;
  return fmt::format(
      "image: {}\nresolution: {}\norigin: [{}, {}, {}]\nnegate: 0\noccupied_thresh: {}\n"
      "free_thresh: {}\nmode: trinary\n",
      scalar(image), grid.cell_m(), origin.x_m, origin.y_m, origin.heading_rad,
      kSavedOccupiedThresh, kSavedFreeThresh);
}

}  // namespace

MapFile read_map_text(std::string_view yaml, const std::string& file_name,
                      const ImageSource& image_source) {
  const MapSettings settings = map_yaml::read_settings(yaml, file_name);
  std::string reason;
  const std::optional<std::string> bytes = image_source(settings.image, reason);
  const std::string image_file = beside(file_name, settings.image);
  if (!bytes) {
    throw ScenarioError(
        {{.severity = Diagnostic::Severity::kError,
          .file = file_name,
          .line = settings.image_spot.line,
          .column = settings.image_spot.column,
          .message = fmt::format("cannot read the image {}: {}", in_quotes(image_file), reason),
          .hint = "the name is relative to the folder of this file"}});
  }
  const std::uint64_t yaml_hash = hash_of(yaml, hash_of(fmt::format("{}:", yaml.size())));
  return {grid_of(read_image(*bytes, image_file), settings), hash_of(*bytes, yaml_hash)};
}

MapFile load_map_file(const std::string& yaml_file) {
  std::string reason;
  const std::optional<std::string> yaml = read_file(yaml_file, kMostYamlBytes, reason);
  if (!yaml) {
    throw ScenarioError(yaml_file, fmt::format("the map cannot be read: {}", reason),
                        "check the name and the folder");
  }
  return read_map_text(*yaml, yaml_file, [&](const std::string& image, std::string& why) {
    return read_file(beside(yaml_file, image), kMostImageBytes, why);
  });
}

void save_map_file(const OccupancyGrid& grid, const std::string& yaml_file) {
  const std::filesystem::path path(yaml_file);
  if (path.extension() != ".yaml" && path.extension() != ".yml") {
    throw ScenarioError(yaml_file, "a map is written as a YAML file and an image beside it",
                        "name the YAML file: " + path.stem().string() + ".yaml");
  }
  const std::filesystem::path image = std::filesystem::path(path).replace_extension(".pgm");
  write_file(image.string(), pgm_of(grid));
  write_file(yaml_file, yaml_of(grid, image.filename().string()));
}

bool looks_like_map_file(std::string_view yaml) {
  std::vector<Diagnostic> ignored;
  try {
    const auto entries = map_yaml::read(yaml, {}, ignored);
    const auto has = [&](std::string_view key) {
      return std::any_of(entries.begin(), entries.end(),
                         [&](const map_yaml::Entry& entry) { return entry.key == key; });
    };
    return has("image") && !has("schema");
  } catch (const ScenarioError&) {
    return false;
  }
}

}  // namespace linewright
