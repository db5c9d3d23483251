#include "linewright/environment/json_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "linewright/base/diagnostic.hpp"

namespace linewright {
namespace {

using Json = nlohmann::json;

/// Watches the parser: nlohmann's own behaviour is to keep the last of equal keys.
class Watch {
 public:
  Watch(const std::string& file, const std::string& title, int deepest)
      : file_(file), title_(title), deepest_(deepest) {}

  void see(int depth, Json::parse_event_t event, const Json& value) {
    switch (event) {
      case Json::parse_event_t::object_start:
      case Json::parse_event_t::array_start:
        if (depth >= deepest_) fail("is nested too deeply");
        keys_.resize(static_cast<std::size_t>(depth) + 2);
        keys_.back().clear();
        break;
      case Json::parse_event_t::key: {
        auto& known = keys_[static_cast<std::size_t>(depth)];
        const auto& key = value.get_ref<const std::string&>();
        if (!known.insert(key).second) fail(fmt::format("has the key {} twice", in_quotes(key)));
        break;
      }
      default:
        break;
    }
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw ScenarioError(file_, fmt::format("{} {}", title_, what), "");
  }

  const std::string& file_;
  const std::string& title_;
  int deepest_;
  std::vector<std::set<std::string>> keys_;
};

}  // namespace

Json parse_json(std::string_view text, const std::string& file, const std::string& title,
                int deepest) {
  Watch watch(file, title, deepest);
  const auto see = [&watch](int depth, Json::parse_event_t event, Json& value) {
    watch.see(depth, event, value);
    return true;
  };
  try {
    return Json::parse(text.begin(), text.end(), see);
  } catch (const Json::parse_error& error) {
    throw ScenarioError(file, fmt::format("{} is not valid JSON (byte {})", title, error.byte), "");
  } catch (const Json::exception&) {
    throw ScenarioError(file, fmt::format("{} holds a number that is too large", title), "");
  }
}

JsonFields::JsonFields(const Json& object, std::string title, const std::string& file)
    : object_(object), title_(std::move(title)), file_(file) {
  if (!object_.is_object()) {
    fail(fmt::format("must be a JSON object, not {}", object_.type_name()));
  }
}

void JsonFields::fail(const std::string& message) const {
  throw ScenarioError(file_, fmt::format("{} {}", title_, message), "");
}

void JsonFields::wrong(const char* key, const std::string& expected) const {
  const Json& value = at(key);
  const std::string shown =
      value.is_structured() ? value.type_name()
                            : in_quotes(value.dump(-1, ' ', false, Json::error_handler_t::replace));
  fail(fmt::format("has '{}': it must be {}, not {}", key, expected, shown));
}

void JsonFields::allow_only(std::initializer_list<const char*> keys) const {
  const std::vector<std::string> known(keys.begin(), keys.end());
  for (const auto& [key, value] : object_.items()) {
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    throw ScenarioError(file_, fmt::format("{} has the unknown key {}", title_, in_quotes(key)),
                        name_hint(key, known));
  }
}

const Json& JsonFields::at(const char* key) const {
  const auto found = object_.find(key);
  if (found == object_.end()) fail(fmt::format("lacks the key '{}'", key));
  return *found;
}

const std::string& JsonFields::text(const char* key) const {
  const Json& value = at(key);
  if (!value.is_string()) wrong(key, "text");
  return value.get_ref<const std::string&>();
}

std::int64_t JsonFields::integer(const char* key, std::int64_t low, std::int64_t high) const {
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

double JsonFields::number(const char* key, double low, double high) const {
  const Json& value = at(key);
  if (value.is_number()) {
    const auto number = value.get<double>();
    if (number >= low && number <= high) return number;
  }
  wrong(key, fmt::format("a number from {:g} to {:g}", low, high));
}

bool JsonFields::boolean(const char* key) const {
  const Json& value = at(key);
  if (!value.is_boolean()) wrong(key, "true or false");
  return value.get<bool>();
}

const Json& JsonFields::list(const char* key) const {
  const Json& value = at(key);
  if (!value.is_array()) wrong(key, "a list");
  return value;
}

std::vector<std::string> JsonFields::texts(const char* key) const {
  return texts_of(list(key), fmt::format("'{}'", key), *this);
}

std::vector<std::string> texts_of(const Json& list, const std::string& title,
                                  const JsonFields& fields) {
  if (!list.is_array()) fields.fail(fmt::format("has {}: it must be a list", title));
  std::vector<std::string> texts;
  for (const Json& value : list) {
    if (!value.is_string()) fields.fail(fmt::format("has {}: it must hold texts only", title));
    texts.push_back(value.get<std::string>());
  }
  return texts;
}

}  // namespace linewright
