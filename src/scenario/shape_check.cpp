#include "linewright/scenario/shape_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "linewright/scenario/values.hpp"

namespace linewright::loading {
namespace {

using Kind = Shape::Kind;

std::string described(const SourceNode& node) {
  switch (node.type) {
    case SourceNode::Type::kScalar:
      return node.was_quoted ? fmt::format("the text {}", in_quotes(node.text))
                             : in_quotes(node.text);
    case SourceNode::Type::kList:
      return "a list";
    case SourceNode::Type::kMapping:
      return "a mapping";
    case SourceNode::Type::kNull:
    case SourceNode::Type::kBroken:
      break;
  }
  return "empty";
}

/// Where in the file the check is: the entry's title, and the keys below it.
struct Location {
  std::string whole;  ///< "the scenario"
  std::string title;  ///< "operation 'weld'"; empty outside of named entries
  std::string path;   ///< "homing.takes"

  [[nodiscard]] Location inside(const std::string& key) const {
    return {whole, title, path.empty() ? key : path + "." + key};
  }
  /// "operation 'weld': 'takes'", to be followed by what is wrong with it.
  [[nodiscard]] std::string subject() const {
    if (path.empty()) return title.empty() ? whole : title;
    return title.empty() ? fmt::format("'{}'", path) : fmt::format("{}: '{}'", title, path);
  }
  [[nodiscard]] std::string prefix() const {
    return path.empty() && title.empty() ? "" : subject() + ": ";
  }
};

bool fits_range(const SourceNode& node, const Shape& shape) {
  if (!node.is_scalar() || node.was_quoted) return false;
  if (shape.kind == Kind::kInteger) {
    const auto number = parse_integer(node.text);
    return number && static_cast<double>(*number) >= shape.min &&
           static_cast<double>(*number) <= shape.max;
  }
  const auto number = parse_real(node.text);
  return number && *number >= shape.min && *number <= shape.max;
}

bool looks_like_number(const SourceNode& node) {
  return node.is_scalar() && !node.was_quoted && parse_real(node.text).has_value();
}

bool is_number(const Shape& shape) {
  return shape.kind == Kind::kInteger || shape.kind == Kind::kReal;
}

bool takes_number(const Shape& shape) {
  if (is_number(shape)) return true;
  return shape.kind == Kind::kOneOf &&
         std::any_of(shape.alternatives.begin(), shape.alternatives.end(),
                     [](const ShapePtr& s) { return is_number(*s); });
}

/// Whether `node` may be read as `shape`, by its type alone.
bool fits_type(const SourceNode& node, const Shape& shape) {
  switch (shape.kind) {
    case Kind::kInteger:
    case Kind::kReal:
      return looks_like_number(node);
    case Kind::kBoolean:
      return node.is_scalar() && !node.was_quoted && (node.text == "true" || node.text == "false");
    case Kind::kChoice:
      return node.is_scalar() && std::find(shape.choices.begin(), shape.choices.end(), node.text) !=
                                     shape.choices.end();
    case Kind::kList:
      return node.is_list();
    case Kind::kMapping:
    case Kind::kVariant:
      return node.is_mapping();
    case Kind::kText:
    case Kind::kName:
    case Kind::kCondition:
      return node.is_scalar();
    case Kind::kOneOf:
      return std::any_of(
          shape.alternatives.begin(), shape.alternatives.end(),
          [&](const ShapePtr& alternative) { return fits_type(node, *alternative); });
  }
  return false;
}

class ShapeChecker {
 public:
  explicit ShapeChecker(Problems& problems) : problems_(problems) {}

  /// Sets `node.sound` of everything that contains a problem.
  void check(SourceNode& node, const Shape& shape, const Location& where) {
    if (node.is_broken()) return;
    const std::size_t before = problems_.count();
    if (takes_number(shape)) pick_number(node, where);
    if (!node.is_broken()) check_kind(node, shape, where);
    node.sound = node.sound && problems_.count() == before;
  }

 private:
  void check_kind(SourceNode& node, const Shape& shape, const Location& where) {
    if (!fits_type(node, shape)) return refuse(node, shape, where);
    switch (shape.kind) {
      case Kind::kInteger:
      case Kind::kReal:
        if (!fits_range(node, shape)) refuse(node, shape, where);
        break;
      case Kind::kList:
        check_list(node, shape, where);
        break;
      case Kind::kMapping:
        check_mapping(node, shape, where);
        break;
      case Kind::kVariant:
        check_variant(node, shape, where);
        break;
      case Kind::kOneOf:
        check_one_of(node, shape, where);
        break;
      default:
        break;
    }
  }

  void refuse(SourceNode& node, const Shape& shape, const Location& where) {
    std::string hint;
    if (shape.kind == Kind::kChoice) hint = problems_.hint(node.text, shape.choices);
    if (node.is_null() && fits_type(empty_mapping(), shape)) hint = "write {} for an empty one";
    problems_.error(
        node.mark,
        fmt::format("{} must be {}, but is {}", where.subject(), shape.expected, described(node)),
        hint);
    node.break_off();
  }

  static SourceNode empty_mapping() {
    SourceNode node;
    node.type = SourceNode::Type::kMapping;
    return node;
  }

  void check_list(SourceNode& node, const Shape& shape, const Location& where) {
    if (node.items.size() < shape.min_items || node.items.size() > shape.max_items) {
      problems_.error(node.mark, fmt::format("{} must be {}, but has {} entries", where.subject(),
                                             shape.expected, node.items.size()));
      node.break_off();
      return;
    }
    for (SourceNode& item : node.items) check(item, *shape.alternatives.front(), where);
    // A list with a hole would shift what follows; where the length is fixed nothing of it is left.
    if (shape.min_items == shape.max_items && has_broken(node)) node.break_off();
  }

  static bool has_broken(const SourceNode& list) {
    return std::any_of(list.items.begin(), list.items.end(),
                       [](const SourceNode& item) { return item.is_broken(); });
  }

  void check_mapping(SourceNode& node, const Shape& shape, const Location& where) {
    if (node.entries.size() > shape.max_entries + shape.fields.size()) {
      problems_.error(node.mark, fmt::format("{} has {} entries, more than {}", where.subject(),
                                             node.entries.size(), shape.max_entries));
      node.break_off();
      return;
    }
    std::vector<SourceEntry> kept;
    for (SourceEntry& entry : node.entries) {
      if (check_entry(entry, shape, where)) kept.push_back(std::move(entry));
    }
    node.entries = std::move(kept);
    for (const Field& field : shape.fields) {
      if (field.required && !has_key(node, field.key)) report_missing(node, field, where);
    }
  }

  bool check_entry(SourceEntry& entry, const Shape& shape, const Location& where) {
    const auto field = std::find_if(shape.fields.begin(), shape.fields.end(),
                                    [&](const Field& f) { return f.key == entry.key; });
    if (field != shape.fields.end()) {
      check(entry.value, *field->shape, where.inside(entry.key));
      return true;
    }
    if (shape.others == nullptr) {
      report_unknown(entry, shape, where);
      return false;
    }
    const Location inside =
        shape.noun.empty()
            ? where.inside(entry.key)
            : Location{where.whole, fmt::format("{} {}", shape.noun, in_quotes(entry.key)), ""};
    check(entry.value, *shape.others, inside);
    return true;
  }

  static bool has_key(const SourceNode& node, std::string_view key) {
    return std::any_of(node.entries.begin(), node.entries.end(),
                       [&](const SourceEntry& entry) { return entry.key == key; });
  }

  void report_unknown(const SourceEntry& entry, const Shape& shape, const Location& where) {
    std::vector<std::string> known;
    for (const Field& field : shape.fields) known.push_back(field.key);
    problems_.error(entry.mark,
                    fmt::format("{}unknown key {}", where.prefix(), in_quotes(entry.key)),
                    problems_.hint(entry.key, known));
  }

  void report_missing(const SourceNode& node, const Field& field, const Location& where) {
    problems_.error(node.mark, fmt::format("{}key '{}' is missing", where.prefix(), field.key),
                    fmt::format("it must be {}", field.shape->expected));
  }

  void check_variant(SourceNode& node, const Shape& shape, const Location& where) {
    const Shape* chosen = nullptr;
    std::string names;
    std::size_t fitting = 0;
    for (const ShapePtr& alternative : shape.alternatives) {
      const std::string& key = alternative->fields.front().key;
      names += (names.empty() ? "" : ", ") + key;
      if (!has_key(node, key)) continue;
      ++fitting;
      chosen = alternative.get();
    }
    if (fitting == 1) {
      check_mapping(node, *chosen, chosen_location(where, *chosen));
      return;
    }
    std::string hint;
    if (fitting == 0 && !node.entries.empty()) hint = nearest_variant(node, shape);
    problems_.error(node.mark,
                    fmt::format("{}exactly one of the keys {} is needed, but there {}",
                                where.prefix(), names, fitting == 0 ? "is none" : "are more"),
                    hint);
    node.break_off();
  }

  static Location chosen_location(const Location& where, const Shape& chosen) {
    return chosen.noun.empty() ? where : where.inside(chosen.noun);
  }

  std::string nearest_variant(const SourceNode& node, const Shape& shape) const {
    std::vector<std::string> known;
    for (const ShapePtr& alternative : shape.alternatives) {
      known.push_back(alternative->fields.front().key);
    }
    return problems_.hint(node.entries.front().key, known);
  }

  void check_one_of(SourceNode& node, const Shape& shape, const Location& where) {
    for (const ShapePtr& alternative : shape.alternatives) {
      if (!fits_type(node, *alternative)) continue;
      const bool whole_message = is_number(*alternative) && !fits_range(node, *alternative);
      return check_kind(node, whole_message ? shape_with(*alternative, shape) : *alternative,
                        where);
    }
  }

  /// The number's range with the wording of all alternatives, for a message that names them all.
  Shape shape_with(const Shape& number, const Shape& all) {
    Shape result = number;
    result.expected = all.expected;
    return result;
  }

  /// `takes: {inner: 11, outer: 10}` within an entry made for one value of a variable: its number.
  void pick_number(SourceNode& node, const Location& where) {
    while (node.is_mapping() && node.bindings != nullptr) {
      const Binding* binding = binding_of(node);
      if (binding == nullptr) return;
      const auto entry =
          std::find_if(node.entries.begin(), node.entries.end(),
                       [&](const SourceEntry& e) { return e.key == binding->value; });
      if (entry == node.entries.end()) {
        problems_.error(
            node.mark,
            fmt::format("{} has no number for {}", where.subject(), in_quotes(binding->value)),
            fmt::format("give one for every value of ${}", binding->variable));
        node.break_off();
        return;
      }
      SourceNode picked = std::move(entry->value);
      node = std::move(picked);
    }
  }

  /// The variable whose values the keys of `node` are.
  static const Binding* binding_of(const SourceNode& node) {
    for (const Binding& binding : *node.bindings) {
      const auto is_value = [&](const SourceEntry& entry) {
        return std::find(binding.values->begin(), binding.values->end(), entry.key) !=
               binding.values->end();
      };
      if (!node.entries.empty() &&
          std::all_of(node.entries.begin(), node.entries.end(), is_value)) {
        return &binding;
      }
    }
    return nullptr;
  }

  Problems& problems_;
};

}  // namespace

void check_shape(SourceNode& root, const Shape& shape, Problems& problems,
                 const std::string& whole) {
  ShapeChecker(problems).check(root, shape, {whole, "", ""});
}

}  // namespace linewright::loading
