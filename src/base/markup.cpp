#include "linewright/base/markup.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace linewright::markup {
namespace {

constexpr const char* kReplacement = "\xEF\xBF\xBD";  // U+FFFD

/// The character at the beginning of `text`.
struct Character {
  std::size_t bytes = 1;
  char32_t code = 0xFFFD;
  bool sound = false;
};

Character first_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned lead = byte(0);
  if (lead < 0x80U) return {1, lead, true};
  const std::size_t length = lead >= 0xF0U ? 4 : lead >= 0xE0U ? 3 : 2;
  if (lead < 0xC2U || lead > 0xF4U || text.size() < length) return {};
  char32_t code = lead & (0x7FU >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) return {};
    code = (code << 6U) | (byte(i) & 0x3FU);
  }
  constexpr char32_t kSmallest[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
  if (code < kSmallest[length] || surrogate || code > 0x10FFFF) return {};
  return {length, code, true};
}

bool allowed_in_xml(char32_t code) {
  return code >= 0x20 && code != 0x7F && code != 0xFFFE && code != 0xFFFF;
}

double relative_width(char32_t code) {
  if (code >= 0x2E80) return 1.05;  // ideographs and symbols
  switch (code) {
    case 'i':
    case 'j':
    case 'l':
    case 't':
    case 'f':
    case 'r':
    case '.':
    case ',':
    case ' ':
    case '|':
    case '(':
    case ')':
      return 0.36;
    case 'm':
    case 'w':
    case 'M':
    case 'W':
      return 0.92;
    default:
      return code >= 'A' && code <= 'Z' ? 0.72 : 0.6;
  }
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  while (!text.empty()) {
    const Character character = first_character(text);
    switch (character.code) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&#39;";
        break;
      case '\t':
      case '\n':
      case '\r':
        result += ' ';
        break;
      default:
        if (character.sound && allowed_in_xml(character.code)) {
          result += text.substr(0, character.bytes);
        } else {
          result += kReplacement;
        }
    }
    text.remove_prefix(character.bytes);
  }
  return result;
}

double text_width(std::string_view text, double font_size) {
  double width = 0.0;
  while (!text.empty()) {
    const Character character = first_character(text);
    width += relative_width(character.code);
    text.remove_prefix(character.bytes);
  }
  return width * font_size;
}

std::string shortened(std::string_view text, double width, double font_size) {
  if (text_width(text, font_size) <= width) return std::string(text);
  std::string result;
  double used = font_size;  // of the ellipsis
  while (!text.empty()) {
    const Character character = first_character(text);
    used += relative_width(character.code) * font_size;
    if (used > width) break;
    result += text.substr(0, character.bytes);
    text.remove_prefix(character.bytes);
  }
  return result + "…";
}

std::string coordinate(double value) {
  std::string text = fmt::format("{:.2f}", value);
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

}  // namespace linewright::markup
