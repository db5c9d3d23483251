#include "linewright/scenario/values.hpp"

#include <charconv>
#include <cmath>
#include <system_error>

namespace linewright::loading {
namespace {

template <class Number>
std::optional<Number> parse_whole(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  Number number{};
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc{} || stop != end) return std::nullopt;
  return number;
}

bool has_leading_zero(std::string_view text) {
  const std::size_t first = text.find_first_not_of("+-");
  return first != std::string_view::npos && text.substr(first).size() > 1 && text[first] == '0';
}

}  // namespace

std::optional<std::int64_t> parse_integer(std::string_view text) {
  if (has_leading_zero(text) || text.starts_with("+-")) return std::nullopt;
  return parse_whole<std::int64_t>(text);
}

std::optional<double> parse_real(std::string_view text) {
  if (text.starts_with("+-")) return std::nullopt;
  const std::optional<double> number = parse_whole<double>(text);
  return number && std::isfinite(*number) ? number : std::nullopt;
}

std::int32_t integer_or(const SourceNode& mapping, std::string_view key, std::int32_t otherwise) {
  const SourceNode* node = mapping.find(key);
  const auto number = node != nullptr ? parse_integer(node->text) : std::nullopt;
  return number ? static_cast<std::int32_t>(*number) : otherwise;
}

double real_or(const SourceNode& mapping, std::string_view key, double otherwise) {
  const SourceNode* node = mapping.find(key);
  return node != nullptr ? parse_real(node->text).value_or(otherwise) : otherwise;
}

bool boolean_or(const SourceNode& mapping, std::string_view key, bool otherwise) {
  const SourceNode* node = mapping.find(key);
  return node != nullptr ? node->text == "true" : otherwise;
}

std::string text_or(const SourceNode& mapping, std::string_view key, std::string_view otherwise) {
  const SourceNode* node = mapping.find(key);
  return std::string(node != nullptr ? std::string_view(node->text) : otherwise);
}

SourceMark mark_of(const SourceNode& mapping, std::string_view key) {
  const SourceNode* node = mapping.find(key);
  return node != nullptr ? node->mark : mapping.mark;
}

}  // namespace linewright::loading
