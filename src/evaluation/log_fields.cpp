#include "log_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "linewright/base/diagnostic.hpp"

namespace linewright::event_log {
namespace {

// Scenarios allow names of 100 bytes; log names add a number. Texts for hovering repeat them often.
constexpr std::size_t kLongestName = 256;
constexpr double kLargestCoordinate = 1e9;
constexpr const char* kSeeFormat =
    "docs/formats/event_log.md lists the keys; simulate the run again";

bool continues_character(char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U; }

}  // namespace

void fail(const LogPosition& where, std::string message, std::string hint) {
  throw ScenarioError({{.severity = Diagnostic::Severity::kError,
                        .file = where.file,
                        .line = where.line,
                        .column = 0,
                        .message = std::move(message),
                        .hint = std::move(hint)}});
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kMost = 60;
  std::size_t length = text.size();
  if (length > kMost) {
    length = kMost;
    while (length > 0 && continues_character(text[length])) --length;
  }
  std::string result = "'";
  for (const char c : text.substr(0, length)) {
    result += static_cast<unsigned char>(c) < 0x20U || c == '\x7f' ? '?' : c;
  }
  return result + (length < text.size() ? "...'" : "'");
}

void LogNames::add(const std::string& name, const LogPosition& where) {
  if (name.size() > kLongestName) {
    fail(where,
         fmt::format("{} {} has a name longer than {} bytes", noun_, in_quotes(name), kLongestName),
         "names of scenarios are shorter; simulate the run again");
  }
  if (!ids_.emplace(name, names_.size()).second) {
    fail(where, fmt::format("{} {} is listed twice", noun_, in_quotes(name)),
         "names must be unique; simulate the run again");
  }
  names_.push_back(name);
}

std::optional<std::size_t> LogNames::find(const std::string& name) const {
  const auto found = ids_.find(name);
  if (found == ids_.end()) return std::nullopt;
  return found->second;
}

std::size_t LogNames::at(const std::string& name, const LogPosition& where) const {
  if (const auto id = find(name)) return *id;
  fail(where, fmt::format("unknown {} {}", noun_, in_quotes(name)),
       names_.empty() ? fmt::format("the header lists no {}", noun_) : name_hint(name, names_));
}

LogFields::LogFields(const Json& object, std::string title, const LogPosition& where)
    : object_(object), title_(std::move(title)), where_(where) {
  if (!object_.is_object()) {
    fail(where_, fmt::format("{} must be a JSON object, not {}", title_, object_.type_name()),
         kSeeFormat);
  }
}

const Json* LogFields::find(const char* key) const {
  const auto found = object_.find(key);
  return found == object_.end() ? nullptr : &*found;
}

const Json& LogFields::at(const char* key) const {
  if (const Json* value = find(key)) return *value;
  fail(where_, fmt::format("{} lacks the key '{}'", title_, key), kSeeFormat);
}

void LogFields::wrong(const char* key, const std::string& expected) const {
  const std::string value =
      at(key).dump(-1, ' ', false, Json::error_handler_t::replace).substr(0, 1000);
  fail(where_,
       fmt::format("'{}' of {} must be {}, not {}", key, title_, expected, in_quotes(value)),
       kSeeFormat);
}

const std::string& LogFields::text(const char* key) const {
  const Json& value = at(key);
  if (!value.is_string()) wrong(key, "text");
  const auto& text = value.get_ref<const std::string&>();
  if (text.size() > kLongestName) wrong(key, fmt::format("at most {} bytes long", kLongestName));
  return text;
}

std::int64_t LogFields::integer(const char* key, std::int64_t low, std::int64_t high) const {
  const Json& value = at(key);
  // Unsigned values beyond the signed range would wrap around.
  const bool fits = value.is_number_integer() &&
                    (!value.is_number_unsigned() || value.get<std::uint64_t>() <= INT64_MAX);
  if (fits) {
    const auto number = value.get<std::int64_t>();
    if (number >= low && number <= high) return number;
  }
  wrong(key, fmt::format("a whole number from {} to {}", low, high));
}

double LogFields::number(const char* key, double low, double high) const {
  const Json& value = at(key);
  if (value.is_number()) {
    const double number = value.get<double>();
    if (number >= low && number <= high) return number;
  }
  wrong(key, fmt::format("a number from {:g} to {:g}", low, high));
}

bool LogFields::boolean(const char* key) const {
  const Json& value = at(key);
  if (!value.is_boolean()) wrong(key, "true or false");
  return value.get<bool>();
}

const Json& LogFields::list(const char* key) const {
  const Json& value = at(key);
  if (!value.is_array()) wrong(key, "a list");
  return value;
}

LogFields LogFields::object(const char* key) const {
  return {at(key), fmt::format("'{}' of {}", key, title_), where_};
}

const std::string& text_of(const Json& value, const std::string& title, const LogPosition& where) {
  if (!value.is_string()) {
    fail(where, fmt::format("{} must hold text only, not {}", title, value.type_name()),
         kSeeFormat);
  }
  const auto& text = value.get_ref<const std::string&>();
  if (text.size() > kLongestName) {
    fail(where, fmt::format("{} holds a name longer than {} bytes", title, kLongestName),
         kSeeFormat);
  }
  return text;
}

std::vector<double> numbers_of(const Json& value, std::size_t count, const std::string& title,
                               const LogPosition& where) {
  const auto fits = [](const Json& element) {
    return element.is_number() && std::abs(element.get<double>()) <= kLargestCoordinate;
  };
  if (value.is_array() && value.size() == count && std::all_of(value.begin(), value.end(), fits)) {
    return value.get<std::vector<double>>();
  }
  fail(where,
       fmt::format("{} must be a list of {} numbers up to {:g}", title, count, kLargestCoordinate),
       kSeeFormat);
}

}  // namespace linewright::event_log
