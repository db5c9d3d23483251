#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace linewright::learning {

/// Plain numbers, one behind the other, in the byte order of the machine: a checkpoint belongs to
/// the machine that made it.
class ByteWriter {
 public:
  template <class Number>
  void put(Number value) {
    static_assert(std::is_arithmetic_v<Number>);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  template <class Number>
  void put_all(const std::vector<Number>& values) {
    static_assert(std::is_arithmetic_v<Number>);
    put(static_cast<std::uint64_t>(values.size()));
    if (values.empty()) return;
    bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Number));
  }
  void put_text(std::string_view text) {
    put(static_cast<std::uint64_t>(text.size()));
    bytes_.append(text);
  }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// Reads what a ByteWriter wrote. Past the end it gives zeros and remembers that it failed.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : rest_(bytes) {}

  template <class Number>
  [[nodiscard]] Number get() {
    static_assert(std::is_arithmetic_v<Number>);
    Number value{};
    if (!enough(1, sizeof value)) return value;
    std::memcpy(&value, rest_.data(), sizeof value);
    rest_.remove_prefix(sizeof value);
    return value;
  }
  template <class Number>
  [[nodiscard]] std::vector<Number> get_all() {
    const auto count = get<std::uint64_t>();
    std::vector<Number> values;
    if (!enough(count, sizeof(Number)) || count == 0) return values;
    values.resize(count);
    std::memcpy(values.data(), rest_.data(), count * sizeof(Number));
    rest_.remove_prefix(count * sizeof(Number));
    return values;
  }
  [[nodiscard]] std::string get_text() {
    const auto count = get<std::uint64_t>();
    if (!enough(count, 1)) return {};
    std::string text(rest_.substr(0, count));
    rest_.remove_prefix(count);
    return text;
  }
  /// How many entries of at least `size` bytes can still follow, for what is read one by one.
  [[nodiscard]] std::uint64_t get_count(std::size_t size) {
    const auto count = get<std::uint64_t>();
    return enough(count, size) ? count : 0;
  }
  /// Everything was there, and nothing is left.
  [[nodiscard]] bool complete() const { return good_ && rest_.empty(); }
  [[nodiscard]] bool good() const { return good_; }

 private:
  bool enough(std::uint64_t count, std::size_t size) {
    if (good_ && count <= rest_.size() / size) return true;
    good_ = false;
    return false;
  }

  std::string_view rest_;
  bool good_ = true;
};

}  // namespace linewright::learning
