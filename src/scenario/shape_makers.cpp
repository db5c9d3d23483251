#include "linewright/scenario/shape_makers.hpp"

#include <fmt/format.h>

#include <memory>
#include <utility>

namespace linewright::loading {

ShapePtr make(Shape shape) { return std::make_shared<const Shape>(std::move(shape)); }

ShapePtr scalar(Shape::Kind kind, std::string expected) {
  Shape shape;
  shape.kind = kind;
  shape.expected = std::move(expected);
  return make(std::move(shape));
}

ShapePtr integer(std::int64_t min, std::int64_t max) {
  Shape shape;
  shape.kind = Shape::Kind::kInteger;
  shape.expected = fmt::format("a whole number from {} to {}", min, max);
  shape.min = static_cast<double>(min);
  shape.max = static_cast<double>(max);
  return make(std::move(shape));
}

ShapePtr real(double min, double max) {
  Shape shape;
  shape.kind = Shape::Kind::kReal;
  shape.expected = fmt::format("a number from {} to {}", min, max);
  shape.min = min;
  shape.max = max;
  return make(std::move(shape));
}

ShapePtr choice(std::vector<std::string> choices) {
  Shape shape;
  shape.kind = Shape::Kind::kChoice;
  for (const std::string& c : choices) shape.expected += (shape.expected.empty() ? "" : " or ") + c;
  shape.choices = std::move(choices);
  return make(std::move(shape));
}

ShapePtr list(ShapePtr of, std::string expected, std::size_t min, std::size_t max) {
  Shape shape;
  shape.kind = Shape::Kind::kList;
  shape.expected = std::move(expected);
  shape.alternatives = {std::move(of)};
  shape.min_items = min;
  shape.max_items = max;
  return make(std::move(shape));
}

ShapePtr mapping(std::string expected, std::vector<Field> fields) {
  Shape shape;
  shape.kind = Shape::Kind::kMapping;
  shape.expected = std::move(expected);
  shape.fields = std::move(fields);
  return make(std::move(shape));
}

ShapePtr names_to(ShapePtr others, std::string expected, std::string noun, std::size_t most) {
  Shape shape;
  shape.kind = Shape::Kind::kMapping;
  shape.expected = std::move(expected);
  shape.others = std::move(others);
  shape.noun = std::move(noun);
  shape.max_entries = most;
  return make(std::move(shape));
}

ShapePtr variant(std::string noun, std::string expected, std::vector<ShapePtr> alternatives) {
  Shape shape;
  shape.kind = Shape::Kind::kVariant;
  shape.noun = std::move(noun);
  shape.expected = std::move(expected);
  shape.alternatives = std::move(alternatives);
  return make(std::move(shape));
}

ShapePtr one_of(std::vector<ShapePtr> alternatives) {
  Shape shape;
  shape.kind = Shape::Kind::kOneOf;
  for (const ShapePtr& s : alternatives) {
    shape.expected += (shape.expected.empty() ? "" : ", or ") + s->expected;
  }
  shape.alternatives = std::move(alternatives);
  return make(std::move(shape));
}

Field key(std::string name, ShapePtr shape, std::string about) {
  return {std::move(name), std::move(shape), std::move(about), false};
}
Field required(std::string name, ShapePtr shape, std::string about) {
  return {std::move(name), std::move(shape), std::move(about), true};
}

}  // namespace linewright::loading
