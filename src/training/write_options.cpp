#include <fmt/format.h>

#include <string>
#include <string_view>
#include <vector>

#include "option_fields.hpp"

namespace linewright {
namespace {

/// A YAML text that is a text whatever stands in it.
std::string quoted(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      result += fmt::format("\\{}", c);
    } else if (byte < 0x20 || byte == 0x7f) {
      result += fmt::format("\\x{:02x}", byte);
    } else {
      result += c;
    }
  }
  return result + '"';
}

class OptionWriter {
 public:
  void group(const char* name) { yaml_ += fmt::format("{}:\n", name); }
  void text(const char* name, const std::string& value) { line(name, quoted(value)); }
  template <class Enum>
  void choice(const char* name, Enum value, const std::vector<std::string>& names) {
    const auto number = static_cast<std::size_t>(value);
    line(name, number < names.size() ? names[number] : std::to_string(number));
  }
  template <class Number>
  void whole(const char* name, Number value, std::int64_t, std::int64_t) {
    line(name, std::to_string(value));
  }
  void real(const char* name, double value, double, double) {
    line(name, fmt::format("{}", value));  // the shortest text that reads back to the same bits
  }
  void flag(const char* name, bool value) { line(name, value ? "true" : "false"); }
  void order(const char* name, const std::optional<std::int32_t>& value, std::int64_t,
             std::int64_t) {
    line(name, value ? std::to_string(*value) : "scenario");
  }
  void horizon(const char* name, const std::vector<HorizonRule>& rules, Tick) {
    if (rules.empty()) return line(name, "scenario");
    std::string list;
    for (const HorizonRule& rule : rules) {
      std::string crew;
      for (const auto& [kind, count] : rule.crew) {
        crew += fmt::format("{}{}: {}", crew.empty() ? "" : ", ", quoted(kind), count);
      }
      list += fmt::format("\n    - {{crew: {{{}}}, ticks: {}}}", crew, rule.ticks);
    }
    yaml_ += fmt::format("  {}:{}\n", name, list);
  }

  [[nodiscard]] std::string take() { return std::move(yaml_); }

 private:
  void line(const char* name, std::string_view value) {
    yaml_ += fmt::format("  {}: {}\n", name, value);
  }

  std::string yaml_;
};

}  // namespace

std::string to_yaml(const TrainingOptions& options) {
  OptionWriter writer;
  training_files::visit_options(options, writer);
  return writer.take();
}

}  // namespace linewright
