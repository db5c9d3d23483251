#include "templates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "linewright/scenario/yaml_reader.hpp"
#include "names.hpp"

namespace linewright::loading {
namespace {

constexpr std::size_t kMostVariables = 8;
constexpr std::size_t kMostValues = 64;

struct Variable {
  std::string name;
  std::shared_ptr<const std::vector<std::string>> values;
};

bool is_word(std::string_view text) {
  return !text.empty() && text.size() <= kMaxNameLength &&
         std::all_of(text.begin(), text.end(), [](char c) {
           return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
         });
}

std::optional<Variable> read_variable(const SourceEntry& entry, Problems& problems) {
  const auto refuse = [&](SourceMark mark, const std::string& what) {
    problems.error(mark, fmt::format("template variable {}: {}", in_quotes(entry.key), what),
                   "write: for: {w: [left, right]}");
    return std::nullopt;
  };
  const bool starts_with_letter =
      std::isalpha(static_cast<unsigned char>(entry.key.c_str()[0])) != 0;
  if (!is_word(entry.key) || !starts_with_letter) {
    return refuse(entry.mark, "a variable is a word of letters, digits and _");
  }
  if (!entry.value.is_list() || entry.value.items.empty()) {
    return refuse(entry.value.mark, "its values must be a list of words");
  }
  if (entry.value.items.size() > kMostValues) {
    return refuse(entry.value.mark, fmt::format("more than {} values", kMostValues));
  }
  std::vector<std::string> values;
  for (const SourceNode& item : entry.value.items) {
    if (!item.is_scalar() || !is_word(item.text) || is_banned_word(item.text)) {
      return refuse(item.mark, fmt::format("{} cannot be a value", in_quotes(item.text)));
    }
    if (std::find(values.begin(), values.end(), item.text) != values.end()) {
      return refuse(item.mark, fmt::format("the value {} is listed twice", in_quotes(item.text)));
    }
    values.push_back(item.text);
  }
  return Variable{entry.key, std::make_shared<const std::vector<std::string>>(std::move(values))};
}

std::vector<Variable> read_variables(const SourceNode& node, Problems& problems) {
  std::vector<Variable> variables;
  if (!node.is_mapping() || node.entries.size() > kMostVariables) {
    problems.error(node.mark,
                   fmt::format("'for' must be a mapping of at most {} variables", kMostVariables),
                   "write: for: {w: [left, right]}");
    return variables;
  }
  for (const SourceEntry& entry : node.entries) {
    if (auto variable = read_variable(entry, problems)) variables.push_back(std::move(*variable));
  }
  return variables;
}

class Expander {
 public:
  Expander(std::vector<Variable> variables, std::size_t weight, Problems& problems)
      : variables_(std::move(variables)), weight_(weight), problems_(problems) {}

  void expand(SourceNode& node, const std::shared_ptr<const Bindings>& bindings) {
    node.bindings = bindings;
    if (node.is_scalar() && !replace(node.text, node.mark, bindings.get())) node.break_off();
    for (SourceNode& item : node.items) expand(item, bindings);
    if (node.is_mapping()) expand_entries(node, bindings);
  }

 private:
  void expand_entries(SourceNode& node, const std::shared_ptr<const Bindings>& bindings) {
    std::vector<SourceEntry> expanded;
    bool has_templates = false;
    for (SourceEntry& entry : node.entries) {
      has_templates = has_templates || entry.key.find('$') != std::string::npos;
      const std::vector<const Variable*> unbound = unbound_in(entry.key, bindings.get());
      if (unbound.empty()) {
        instantiate(std::move(entry), bindings, expanded);
      } else {
        multiply(entry, unbound, bindings, expanded);
      }
    }
    node.entries = std::move(expanded);
    if (has_templates) refuse_twins(node);
  }

  void instantiate(SourceEntry entry, const std::shared_ptr<const Bindings>& bindings,
                   std::vector<SourceEntry>& expanded) {
    if (!replace(entry.key, entry.mark, bindings.get())) return;
    expand(entry.value, bindings);
    expanded.push_back(std::move(entry));
  }

  /// One copy per combination of values; the variable named first in `for` changes slowest.
  void multiply(const SourceEntry& entry, const std::vector<const Variable*>& variables,
                const std::shared_ptr<const Bindings>& outer, std::vector<SourceEntry>& expanded) {
    std::vector<std::size_t> digits(variables.size(), 0);
    const std::size_t weight = weight_of(entry.key) + weight_of(entry.value);
    while (true) {
      if (!may_add(weight, entry.mark)) return;
      auto bindings = std::make_shared<Bindings>(outer ? *outer : Bindings{});
      for (std::size_t i = 0; i < variables.size(); ++i) {
        const Variable& v = *variables[i];
        bindings->push_back({v.name, (*v.values)[digits[i]], v.values});
      }
      instantiate(entry, bindings, expanded);
      std::size_t i = variables.size();
      while (i > 0 && ++digits[i - 1] == variables[i - 1]->values->size()) digits[--i] = 0;
      if (i == 0) return;
    }
  }

  bool may_add(std::size_t weight, SourceMark mark) {
    if (weight_ > kMaxWeight) return false;  // was reported
    weight_ += weight;
    if (weight_ <= kMaxWeight) return true;
    problems_.error(mark, fmt::format("the templates make more than {} values", kMaxWeight),
                    "use fewer values per variable");
    return false;
  }

  /// The declared variable whose name follows the `$` at `dollar`; the longest if several do.
  [[nodiscard]] const Variable* variable_at(std::string_view text, std::size_t dollar) const {
    const Variable* best = nullptr;
    for (const Variable& variable : variables_) {
      if (!text.substr(dollar + 1).starts_with(variable.name)) continue;
      if (best == nullptr || variable.name.size() > best->name.size()) best = &variable;
    }
    return best;
  }

  static const Binding* bound(const Variable& variable, const Bindings* bindings) {
    if (bindings == nullptr) return nullptr;
    const auto found =
        std::find_if(bindings->begin(), bindings->end(),
                     [&](const Binding& binding) { return binding.variable == variable.name; });
    return found == bindings->end() ? nullptr : &*found;
  }

  /// The variables in `key` that have no value yet, in the order of `for`.
  [[nodiscard]] std::vector<const Variable*> unbound_in(std::string_view key,
                                                        const Bindings* bindings) const {
    std::vector<const Variable*> found;
    for (std::size_t i = key.find('$'); i != std::string_view::npos; i = key.find('$', i + 1)) {
      const Variable* variable = variable_at(key, i);
      if (variable == nullptr || bound(*variable, bindings) != nullptr) continue;
      if (std::find(found.begin(), found.end(), variable) == found.end()) found.push_back(variable);
    }
    std::sort(found.begin(), found.end());
    return found;
  }

  /// False when `text` names a variable that has no value here; that was reported then.
  bool replace(std::string& text, SourceMark mark, const Bindings* bindings) {
    if (text.find('$') == std::string::npos) return true;
    std::string result;
    std::size_t i = 0;
    while (i < text.size()) {
      if (text[i] != '$') {
        result += text[i++];
        continue;
      }
      const Variable* variable = variable_at(text, i);
      const Binding* binding = variable != nullptr ? bound(*variable, bindings) : nullptr;
      if (binding == nullptr) {
        refuse_variable(text, variable, mark);
        return false;
      }
      result += binding->value;
      i += 1 + variable->name.size();
    }
    text = std::move(result);
    return may_add(weight_of(text), mark);
  }

  void refuse_variable(const std::string& text, const Variable* variable, SourceMark mark) {
    if (variable != nullptr) {
      problems_.error(
          mark, fmt::format("{}: ${} has no value here", in_quotes(text), variable->name),
          fmt::format("a variable has a value inside of entries whose name contains ${}",
                      variable->name));
      return;
    }
    problems_.error(mark, fmt::format("{}: there is no such template variable", in_quotes(text)),
                    variables_.empty() ? "declare it: for: {w: [left, right]}" : known_variables());
  }

  [[nodiscard]] std::string known_variables() const {
    std::string list = "known:";
    for (const Variable& variable : variables_) list += " $" + variable.name;
    return list;
  }

  void refuse_twins(SourceNode& node) {
    std::map<std::string, int> seen;
    std::vector<SourceEntry> kept;
    for (SourceEntry& entry : node.entries) {
      const auto [first, is_new] = seen.try_emplace(entry.key, entry.mark.line);
      if (is_new) {
        kept.push_back(std::move(entry));
        continue;
      }
      problems_.error(
          entry.mark, fmt::format("key {} exists twice", in_quotes(entry.key)),
          fmt::format("the other one is in line {}, one of them from a template", first->second));
      node.sound = false;
    }
    node.entries = std::move(kept);
  }

  std::vector<Variable> variables_;
  std::size_t weight_;
  Problems& problems_;
};

}  // namespace

void expand_templates(SourceNode& root, Problems& problems) {
  std::vector<Variable> variables;
  const auto entry = std::find_if(root.entries.begin(), root.entries.end(),
                                  [](const SourceEntry& e) { return e.key == "for"; });
  if (entry != root.entries.end()) {
    variables = read_variables(entry->value, problems);
    root.entries.erase(entry);
  }
  Expander(std::move(variables), weight_of(root), problems).expand(root, nullptr);
}

}  // namespace linewright::loading
