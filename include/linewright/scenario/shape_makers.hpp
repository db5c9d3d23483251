#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "linewright/scenario/shape.hpp"

// Short names for building tables of shapes. `expected` ends the message "must be ...".
namespace linewright::loading {

[[nodiscard]] ShapePtr make(Shape shape);

/// A kind of scalar without any limits.
[[nodiscard]] ShapePtr scalar(Shape::Kind kind, std::string expected);
/// Both limits included.
[[nodiscard]] ShapePtr integer(std::int64_t min, std::int64_t max);
[[nodiscard]] ShapePtr real(double min, double max);
[[nodiscard]] ShapePtr choice(std::vector<std::string> choices);

[[nodiscard]] ShapePtr list(ShapePtr of, std::string expected, std::size_t min = 0,
                            std::size_t max = 1000);
[[nodiscard]] ShapePtr mapping(std::string expected, std::vector<Field> fields);
/// A mapping from names to values; `noun` when its entries are things of their own in messages.
[[nodiscard]] ShapePtr names_to(ShapePtr others, std::string expected, std::string noun = {},
                                std::size_t most = 1000);
/// Mappings told apart by the first key of their fields.
[[nodiscard]] ShapePtr variant(std::string noun, std::string expected,
                               std::vector<ShapePtr> alternatives);
[[nodiscard]] ShapePtr one_of(std::vector<ShapePtr> alternatives);

/// A key that may be left out.
[[nodiscard]] Field key(std::string name, ShapePtr shape, std::string about);
[[nodiscard]] Field required(std::string name, ShapePtr shape, std::string about);

}  // namespace linewright::loading
