#include <algorithm>
#include <string>
#include <vector>

#include "linewright/scenario/values.hpp"
#include "option_fields.hpp"
#include "option_nodes.hpp"

namespace linewright::training_files {
namespace {

using loading::SourceNode;

std::int64_t whole_number(const SourceNode& node) {
  return loading::parse_integer(node.text).value_or(0);  // the shape was checked
}

/// Sets every option whose key is there.
class OptionReader {
 public:
  explicit OptionReader(const SourceNode& root) : root_(root) {}

  void group(const char* name) { group_ = root_.find(name); }
  void text(const char* name, std::string& value) {
    if (const SourceNode* node = find(name)) value = node->text;
  }
  template <class Enum>
  void choice(const char* name, Enum& value, const std::vector<std::string>& names) {
    const SourceNode* node = find(name);
    if (node == nullptr) return;
    const auto found = std::find(names.begin(), names.end(), node->text);
    value = static_cast<Enum>(found - names.begin());
  }
  template <class Number>
  void whole(const char* name, Number& value, std::int64_t, std::int64_t) {
    if (const SourceNode* node = find(name)) value = static_cast<Number>(whole_number(*node));
  }
  void real(const char* name, double& value, double, double) {
    if (const SourceNode* node = find(name)) {
      value = loading::parse_real(node->text).value_or(value);
    }
  }
  void flag(const char* name, bool& value) {
    if (const SourceNode* node = find(name)) value = node->text == "true";
  }
  void order(const char* name, std::optional<std::int32_t>& value, std::int64_t, std::int64_t) {
    const SourceNode* node = find(name);
    if (node == nullptr) return;
    value.reset();
    if (node->text != "scenario") value = static_cast<std::int32_t>(whole_number(*node));
  }
  void horizon(const char* name, std::vector<HorizonRule>& value, Tick) {
    const SourceNode* node = find(name);
    if (node == nullptr) return;
    value.clear();
    if (node->is_scalar() && node->text != "scenario") {
      value.push_back({{}, static_cast<Tick>(whole_number(*node))});
    }
    for (const SourceNode& item : node->items) value.push_back(rule(item));
  }

 private:
  [[nodiscard]] const SourceNode* find(const char* name) const {
    return group_ != nullptr ? group_->find(name) : nullptr;
  }
  static HorizonRule rule(const SourceNode& node) {
    HorizonRule rule;
    rule.ticks = static_cast<Tick>(whole_number(*node.find("ticks")));
    if (const SourceNode* crew = node.find("crew")) {
      for (const loading::SourceEntry& entry : crew->entries) {
        rule.crew.emplace_back(entry.key, static_cast<std::int32_t>(whole_number(entry.value)));
      }
    }
    return rule;
  }

  const SourceNode& root_;
  const SourceNode* group_ = nullptr;
};

}  // namespace

TrainingOptions read_options(const SourceNode& root) {
  TrainingOptions options;
  OptionReader reader(root);
  visit_options(options, reader);
  return options;
}

}  // namespace linewright::training_files
