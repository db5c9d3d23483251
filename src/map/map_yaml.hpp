#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "linewright/base/diagnostic.hpp"

// The YAML of map_server: one mapping of single values and lists of them, nothing below.
namespace linewright::map_yaml {

inline constexpr std::size_t kMostBytes = std::size_t{1} << 16;  ///< of one file

/// Where in the file, both 1-based.
struct Spot {
  int line = 0;
  int column = 0;
};

struct Value {
  std::string text;
  Spot spot;
};

struct Entry {
  std::string key;
  Spot spot;
  bool is_list = false;
  std::vector<Value> values;  ///< exactly one unless it is a list
};

/// The entries in the order of the file. Keys that stand twice are added to `found` and left out.
/// Throws ScenarioError when the text cannot be read at all.
[[nodiscard]] std::vector<Entry> read(std::string_view text, const std::string& file,
                                      std::vector<Diagnostic>& found);

}  // namespace linewright::map_yaml
