#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace linewright::loading {

struct Shape;
using ShapePtr = std::shared_ptr<const Shape>;

/// One key that a mapping may have.
struct Field {
  std::string key;
  ShapePtr shape;
  std::string about;  ///< one sentence for the JSON Schema
  bool required = false;
};

/// What a value of a YAML file may look like. A format is one table of shapes, which files are
/// checked against (shape_check.hpp) and which schemas are made from.
struct Shape {
  enum class Kind : std::uint8_t {
    kText,  ///< any scalar
    kName,  ///< a scalar that names something; whether it exists is checked when it is resolved
    kCondition,  ///< a scalar, parsed later
    kInteger,    ///< min..max
    kReal,       ///< min..max, finite
    kBoolean,
    kChoice,   ///< one of `choices`
    kList,     ///< of alternatives[0], min_items..max_items
    kMapping,  ///< `fields`, and any name as a further key when `others` is set
    kVariant,  ///< a mapping like that alternative whose first key it has
    kOneOf,    ///< the alternative that fits its type
  };

  Kind kind = Kind::kText;
  std::string expected;  ///< for messages: "must be ..."
  double min = 0.0;
  double max = 0.0;
  std::vector<std::string> choices;
  std::vector<Field> fields;
  ShapePtr others;
  /// Mappings with `others`: what an entry is called in messages. Variants: their name in the JSON
  /// Schema; their alternatives: the key they are told apart by. May be empty.
  std::string noun;
  std::size_t max_entries = 1000;
  std::vector<ShapePtr> alternatives;
  std::size_t min_items = 0;
  std::size_t max_items = 1000;
};

}  // namespace linewright::loading
