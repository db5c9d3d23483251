#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "linewright/scenario/load.hpp"
#include "scenario_shape.hpp"

namespace linewright {
namespace {

using Json = nlohmann::ordered_json;
using loading::Field;
using loading::Shape;
using loading::ShapePtr;
using Kind = loading::Shape::Kind;

/// A file that extends another one may leave out what it does not change, and write null to remove.
enum class Extent { kWhole, kPart };

Json limit(double bound) {
  if (bound == std::floor(bound)) return static_cast<std::int64_t>(bound);  // 64, not 64.0
  return bound;
}

/// A number, or one per value of a template variable.
Json number(const Shape& shape) {
  Json plain;
  plain["type"] = shape.kind == Kind::kInteger ? "integer" : "number";
  plain["minimum"] = limit(shape.min);
  plain["maximum"] = limit(shape.max);
  Json per_value;
  per_value["type"] = "object";
  per_value["minProperties"] = 1;
  per_value["additionalProperties"] = plain;
  Json schema;
  schema["description"] = shape.expected + ", or one per value of a template variable";
  schema["anyOf"] = {plain, per_value};
  return schema;
}

/// "a whole number from 0 to 64" as a key: whole_number_from_0_to_64
std::string definition_name(const Shape& shape) {
  if (!shape.noun.empty()) return shape.noun;
  std::string name = shape.expected.substr(shape.expected.find(' ') + 1);
  std::replace_if(
      name.begin(), name.end(),
      [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; }, '_');
  return name;
}

/// Turns shapes into JSON. What is used in many places becomes a definition of its own.
class SchemaWriter {
 public:
  Json write(const Shape& shape, Extent extent) {
    switch (shape.kind) {
      case Kind::kInteger:
      case Kind::kReal:
        return defined(shape, [&] { return number(shape); });
      case Kind::kBoolean:
        return {{"type", "boolean"}};
      case Kind::kChoice:
        if (shape.choices == std::vector<std::string>{"true"}) return {{"const", true}};
        return {{"enum", shape.choices}};
      case Kind::kList:
        return list(shape, extent);
      case Kind::kMapping:
        return mapping(shape, extent);
      case Kind::kVariant:
        // Actions and the like are replaced as a whole, never merged with what they extend.
        return defined(shape, [&] { return alternatives("oneOf", shape, Extent::kWhole); });
      case Kind::kOneOf:
        return alternatives("anyOf", shape, extent);
      case Kind::kText:
      case Kind::kName:
      case Kind::kCondition:
        break;
    }
    return {{"type", "string"}};
  }

  [[nodiscard]] const Json& definitions() const { return definitions_; }

 private:
  template <class Make>
  Json defined(const Shape& shape, const Make& make) {
    const std::string name = definition_name(shape);
    if (!definitions_.contains(name)) {
      Json definition = make();
      definitions_[name] = std::move(definition);
    }
    return {{"$ref", "#/$defs/" + name}};
  }

  Json list(const Shape& shape, Extent extent) {
    Json schema;
    schema["type"] = "array";
    schema["items"] = write(*shape.alternatives.front(), extent);
    if (shape.min_items > 0) schema["minItems"] = shape.min_items;
    schema["maxItems"] = shape.max_items;
    return schema;
  }

  Json or_null(Json schema, Extent extent) {
    if (extent == Extent::kWhole) return schema;
    Json either;
    either["anyOf"] = {std::move(schema), {{"type", "null"}}};
    return either;
  }

  Json property(const Field& field, Extent extent) {
    Json schema;
    schema["description"] = field.about;
    schema.update(or_null(write(*field.shape, extent), extent));
    return schema;
  }

  Json mapping(const Shape& shape, Extent extent) {
    Json schema;
    schema["type"] = "object";
    Json required = Json::array();
    for (const Field& field : shape.fields) {
      schema["properties"][field.key] = property(field, extent);
      if (field.required && extent == Extent::kWhole) required.push_back(field.key);
    }
    if (!required.empty()) schema["required"] = required;
    if (shape.others == nullptr) {
      schema["additionalProperties"] = false;
    } else {
      schema["additionalProperties"] = or_null(write(*shape.others, extent), extent);
    }
    return schema;
  }

  Json alternatives(const char* keyword, const Shape& shape, Extent extent) {
    Json all = Json::array();
    for (const ShapePtr& alternative : shape.alternatives)
      all.push_back(write(*alternative, extent));
    return {{keyword, all}};
  }

  Json definitions_ = Json::object();
};

}  // namespace

std::string scenario_json_schema() {
  SchemaWriter writer;
  Json schema;
  schema["$schema"] = "https://json-schema.org/draft/2020-12/schema";
  schema["title"] = "Linewright scenario (line/1)";
  schema["description"] =
      "One production line and the run to make on it; see docs/formats/scenario.md";
  schema["if"] = {{"required", {"extends"}}};
  schema["then"] = {{"$ref", "#/$defs/extension"}};
  schema["else"] = {{"$ref", "#/$defs/whole"}};
  Json whole = writer.write(loading::scenario_shape(), Extent::kWhole);
  Json extension = writer.write(loading::scenario_shape(), Extent::kPart);
  schema["$defs"]["whole"] = std::move(whole);
  schema["$defs"]["extension"] = std::move(extension);
  schema["$defs"].update(writer.definitions());
  return schema.dump(2) + "\n";
}

}  // namespace linewright
