#pragma once

#include <cstdint>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

// Reading JSON that may be anything, with messages that name the file and the object.
namespace linewright {

/// Parses JSON. Throws ScenarioError naming `file` and `title` (what the text is) for text that is
/// not JSON, for a key that an object has twice and for more than `deepest` levels of nesting.
[[nodiscard]] nlohmann::json parse_json(std::string_view text, const std::string& file,
                                        const std::string& title, int deepest);

/// One JSON object. Every getter throws ScenarioError, naming file, title and key, when the key is
/// absent or its value is not what it must be. Keeps references: json and file must outlive it.
class JsonFields {
 public:
  /// Refuses what is not an object; `title` names it in messages.
  JsonFields(const nlohmann::json& object, std::string title, const std::string& file);

  /// Refuses keys other than these.
  void allow_only(std::initializer_list<const char*> keys) const;

  [[nodiscard]] bool has(const char* key) const { return object_.contains(key); }
  [[nodiscard]] const nlohmann::json& at(const char* key) const;
  [[nodiscard]] const std::string& text(const char* key) const;
  [[nodiscard]] std::int64_t integer(const char* key, std::int64_t low, std::int64_t high) const;
  [[nodiscard]] double number(const char* key, double low, double high) const;
  [[nodiscard]] bool boolean(const char* key) const;
  [[nodiscard]] const nlohmann::json& list(const char* key) const;
  [[nodiscard]] std::vector<std::string> texts(const char* key) const;

  [[nodiscard]] const std::string& title() const { return title_; }
  [[noreturn]] void fail(const std::string& message) const;
  /// Refuses the value under `key`, which is there.
  [[noreturn]] void wrong(const char* key, const std::string& expected) const;

 private:
  const nlohmann::json& object_;
  std::string title_;
  const std::string& file_;
};

/// The texts of a list; `title` names it in messages of `fields`.
[[nodiscard]] std::vector<std::string> texts_of(const nlohmann::json& list,
                                                const std::string& title, const JsonFields& fields);

}  // namespace linewright
