#include "map_settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <system_error>
#include <utility>

namespace linewright::map_yaml {
namespace {

/// A key of the file, what to write when it is missing, and whether it must be there. Everything
/// that ROS demands is demanded, so that a file that is read here is read there.
struct Key {
  const char* name;
  const char* example;
  bool required;
};

constexpr std::array<Key, 7> kKeys = {{{"image", "the image's file, such as hall.pgm", true},
                                       {"resolution", "metres per pixel, such as 0.05", true},
                                       {"origin", "[x, y, yaw] of the lower left corner", true},
                                       {"negate", "0 (black is occupied) or 1", true},
                                       {"occupied_thresh", "0.65 is usual", true},
                                       {"free_thresh", "0.196 is usual", true},
                                       {"mode", "trinary, scale or raw", false}}};

constexpr const char* kOriginHint =
    "write [x, y, yaw] of the lower left corner: metres and radians";
constexpr const char* kThresholdHint =
    "ROS writes 0.65 for occupied_thresh and 0.196 for free_thresh";

constexpr double kSmallestPixel = 1e-3;
constexpr double kLargestPixel = 100.0;
constexpr double kLargestCoordinate = 1e5;
constexpr double kLargestYaw = 100.0;

std::optional<double> number_in(const std::string& written) {
  std::string_view text = written;
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  double number = 0.0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || stop != text.data() + text.size() || !std::isfinite(number)) {
    return std::nullopt;
  }
  return number;
}

class SettingsReader {
 public:
  SettingsReader(std::string_view yaml, const std::string& file)
      : file_(file), entries_(read(yaml, file, found_)) {}

  MapSettings read_all() {
    check_keys();
    if (const Value* value = single("image")) {
      settings_.image = value->text;
      settings_.image_spot = value->spot;
      if (value->text.empty()) complain(value->spot, "'image' is empty", "name the image's file");
    }
    real("resolution", kSmallestPixel, kLargestPixel, settings_.resolution_m,
         "metres per pixel, such as 0.05");
    read_origin();
    read_negate();
    read_thresholds();
    read_mode();
    if (!found_.empty()) throw ScenarioError(in_order());
    return std::move(settings_);
  }

 private:
  void complain(Spot spot, std::string message, std::string hint) {
    found_.push_back({.severity = Diagnostic::Severity::kError,
                      .file = file_,
                      .line = spot.line,
                      .column = spot.column,
                      .message = std::move(message),
                      .hint = std::move(hint)});
  }

  std::vector<Diagnostic> in_order() {
    std::stable_sort(found_.begin(), found_.end(), [](const Diagnostic& a, const Diagnostic& b) {
      return std::pair(a.line, a.column) < std::pair(b.line, b.column);
    });
    constexpr std::size_t kMostKept = 100;  // more than anybody reads
    if (found_.size() > kMostKept) found_.resize(kMostKept);
    return std::move(found_);
  }

  [[nodiscard]] const Entry* find(std::string_view key) const {
    const auto entry = std::find_if(entries_.begin(), entries_.end(),
                                    [&](const Entry& e) { return e.key == key; });
    return entry == entries_.end() ? nullptr : &*entry;
  }

  void check_keys() {
    std::vector<std::string> names;
    names.reserve(kKeys.size());
    for (const Key& key : kKeys) names.emplace_back(key.name);
    constexpr std::size_t kMostHints = 20;  // comparing with every name takes time
    for (const Entry& entry : entries_) {
      if (std::find(names.begin(), names.end(), entry.key) != names.end()) continue;
      complain(entry.spot, fmt::format("unknown key {}", in_quotes(entry.key)),
               found_.size() < kMostHints ? name_hint(entry.key, names) : "");
    }
    for (const Key& key : kKeys) {
      if (!key.required || find(key.name) != nullptr) continue;
      complain({}, fmt::format("key '{}' is missing", key.name),
               fmt::format("write {}: {}", key.name, key.example));
    }
  }

  /// The single value of a key; complains about a list.
  const Value* single(const char* key) {
    const Entry* entry = find(key);
    if (entry == nullptr) return nullptr;
    if (!entry->is_list) return &entry->values.front();
    complain(entry->spot, fmt::format("'{}' must be a single value, but is a list", key),
             "remove the brackets");
    return nullptr;
  }

  bool real_in(const Value& value, const std::string& what, double min, double max, double& into,
               const std::string& hint) {
    const auto number = number_in(value.text);
    if (number && *number >= min && *number <= max) {
      into = *number;
      return true;
    }
    complain(value.spot,
             fmt::format("{} must be a number from {} to {}, but is {}", what, min, max,
                         value.text.empty() ? "empty" : in_quotes(value.text)),
             hint);
    return false;
  }

  bool real(const char* key, double min, double max, double& into, const std::string& hint) {
    const Value* value = single(key);
    return value != nullptr && real_in(*value, fmt::format("'{}'", key), min, max, into, hint);
  }

  void read_origin() {
    const Entry* entry = find("origin");
    if (entry == nullptr) return;
    if (!entry->is_list || entry->values.size() != 3) {
      complain(entry->spot,
               entry->is_list
                   ? fmt::format("'origin' must be three numbers, but has {}", entry->values.size())
                   : "'origin' must be three numbers, but is a single value",
               kOriginHint);
      return;
    }
    real_in(entry->values[0], "x of 'origin'", -kLargestCoordinate, kLargestCoordinate,
            settings_.origin.x_m, kOriginHint);
    real_in(entry->values[1], "y of 'origin'", -kLargestCoordinate, kLargestCoordinate,
            settings_.origin.y_m, kOriginHint);
    real_in(entry->values[2], "yaw of 'origin'", -kLargestYaw, kLargestYaw,
            settings_.origin.heading_rad, kOriginHint);
  }

  void read_negate() {
    const Value* value = single("negate");
    if (value == nullptr) return;
    settings_.negate = value->text == "1" || value->text == "true";
    if (settings_.negate || value->text == "0" || value->text == "false") return;
    complain(value->spot, fmt::format("'negate' must be 0 or 1, but is {}", in_quotes(value->text)),
             "0: black is occupied; 1: white is");
  }

  void read_thresholds() {
    const bool occupied =
        real("occupied_thresh", 0.0, 1.0, settings_.occupied_thresh, kThresholdHint);
    const bool free = real("free_thresh", 0.0, 1.0, settings_.free_thresh, kThresholdHint);
    if (!occupied || !free || settings_.free_thresh <= settings_.occupied_thresh) return;
    complain(find("free_thresh")->values.front().spot,
             fmt::format("'free_thresh' {} is above 'occupied_thresh' {}", settings_.free_thresh,
                         settings_.occupied_thresh),
             "pixels darker than 'occupied_thresh' are occupied, brighter than 'free_thresh' free");
  }

  void read_mode() {
    const Value* value = single("mode");
    if (value == nullptr) return;
    static const std::vector<std::string> kModes = {"trinary", "scale", "raw"};
    const auto mode = std::find(kModes.begin(), kModes.end(), value->text);
    if (mode == kModes.end()) {
      complain(value->spot, fmt::format("there is no mode {}", in_quotes(value->text)),
               name_hint(value->text, kModes));
      return;
    }
    settings_.mode = static_cast<Mode>(mode - kModes.begin());
  }

  const std::string& file_;
  std::vector<Diagnostic> found_;
  std::vector<Entry> entries_;
  MapSettings settings_;
};

}  // namespace

MapSettings read_settings(std::string_view yaml, const std::string& file) {
  return SettingsReader(yaml, file).read_all();
}

}  // namespace linewright::map_yaml
