#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// Reading JSON objects key by key, with messages that name file, line, object and key.
namespace linewright::event_log {

using Json = nlohmann::json;

/// A line of a file, for messages.
struct LogPosition {
  std::string file;
  int line = 0;
};

[[noreturn]] void fail(const LogPosition& where, std::string message, std::string hint);

/// In single quotes, control characters replaced, long text cut: safe to put into a message.
[[nodiscard]] std::string in_quotes(std::string_view text);

/// The names of one kind of thing and their ids.
class LogNames {
 public:
  /// `noun`: what one of them is called in messages.
  explicit LogNames(std::string noun) : noun_(std::move(noun)) {}

  /// Gives the name the next id; refuses one that is there already.
  void add(const std::string& name, const LogPosition& where);
  [[nodiscard]] std::optional<std::size_t> find(const std::string& name) const;
  /// Refuses a name that is not there.
  [[nodiscard]] std::size_t at(const std::string& name, const LogPosition& where) const;

  [[nodiscard]] const std::string& noun() const { return noun_; }
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }

 private:
  std::string noun_;
  std::vector<std::string> names_;
  std::map<std::string, std::size_t> ids_;
};

/// One JSON object. Every getter throws ScenarioError when the key is absent or its value is not
/// what it must be.
class LogFields {
 public:
  /// `title` names the object in messages: "event 'go'".
  LogFields(const Json& object, std::string title, const LogPosition& where);

  [[nodiscard]] const LogPosition& where() const { return where_; }
  [[nodiscard]] const std::string& title() const { return title_; }
  [[nodiscard]] const Json* find(const char* key) const;
  [[nodiscard]] const Json& at(const char* key) const;

  /// Text of at most a few hundred bytes.
  [[nodiscard]] const std::string& text(const char* key) const;
  [[nodiscard]] std::int64_t integer(const char* key, std::int64_t low, std::int64_t high) const;
  [[nodiscard]] double number(const char* key, double low, double high) const;
  [[nodiscard]] bool boolean(const char* key) const;
  [[nodiscard]] const Json& list(const char* key) const;
  [[nodiscard]] LogFields object(const char* key) const;
  [[nodiscard]] const Json& json() const { return object_; }

  /// The id that the text under `key` names.
  template <class IdType>
  [[nodiscard]] IdType id(const char* key, const LogNames& names) const {
    return IdType(names.at(text(key), where_));
  }

  /// Refuses the value under `key`, which is there.
  [[noreturn]] void wrong(const char* key, const std::string& expected) const;

 private:
  const Json& object_;
  std::string title_;
  const LogPosition& where_;
};

/// Text that is an element of a list; `title` names the list in messages.
[[nodiscard]] const std::string& text_of(const Json& value, const std::string& title,
                                         const LogPosition& where);

/// A list of exactly `count` numbers of reasonable size (coordinates); `title` names it in
/// messages.
[[nodiscard]] std::vector<double> numbers_of(const Json& value, std::size_t count,
                                             const std::string& title, const LogPosition& where);

}  // namespace linewright::event_log
