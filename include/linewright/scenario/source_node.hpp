#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "linewright/scenario/problems.hpp"

namespace linewright::loading {

/// A template variable inside an entry that was made from a template.
struct Binding {
  std::string variable;
  std::string value;
  std::shared_ptr<const std::vector<std::string>> values;  ///< all that the variable takes
};
using Bindings = std::vector<Binding>;

struct SourceEntry;

/// One value of a scenario file, with the spot where it was written. Our own tree instead of
/// yaml-cpp's: it is a plain value, has no aliases, and can be merged, expanded and marked broken.
struct SourceNode {
  enum class Type : std::uint8_t {
    kNull,
    kScalar,
    kList,
    kMapping,
    kBroken,  ///< was reported as wrong already; read as if it were not there
  };

  Type type = Type::kNull;
  bool was_quoted =
      false;          ///< scalars: written in quotes, hence a text also when it looks like a number
  bool sound = true;  ///< false: something in here was reported
  SourceMark mark;
  std::string text;                          ///< scalars
  std::vector<SourceNode> items;             ///< lists
  std::vector<SourceEntry> entries;          ///< mappings, in file order
  std::shared_ptr<const Bindings> bindings;  ///< on the value of an entry made from a template

  [[nodiscard]] bool is_null() const { return type == Type::kNull; }
  [[nodiscard]] bool is_scalar() const { return type == Type::kScalar; }
  [[nodiscard]] bool is_list() const { return type == Type::kList; }
  [[nodiscard]] bool is_mapping() const { return type == Type::kMapping; }
  [[nodiscard]] bool is_broken() const { return type == Type::kBroken; }

  /// The value of `key`; null when this is no mapping, has no such key, or its value is broken.
  [[nodiscard]] const SourceNode* find(std::string_view key) const;
  [[nodiscard]] SourceNode* find(std::string_view key);

  /// Forgets the content, so that what reads it later sees nothing and stays silent.
  void break_off();
};

struct SourceEntry {
  std::string key;
  SourceMark mark;  ///< of the key
  SourceNode value;
};

/// What limits are counted in: one for every node, more for one with a long text.
[[nodiscard]] std::size_t weight_of(const SourceNode& node);
[[nodiscard]] std::size_t weight_of(std::string_view text);

/// Levels of nesting; 1 for a scalar.
[[nodiscard]] std::size_t depth_of(const SourceNode& node);

/// FNV-1a over keys and values in order; comments, layout and quoting do not matter.
[[nodiscard]] std::uint64_t content_hash(const SourceNode& root);

}  // namespace linewright::loading
