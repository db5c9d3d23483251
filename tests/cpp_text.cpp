#include "tests/cpp_text.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>

namespace linewright::architecture {
namespace {

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool is_space(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

/// The end of the string or character literal whose opening quote is at `open`.
std::size_t end_of_literal(std::string_view source, std::size_t open) {
  const char quote = source[open];
  if (quote == '"' && open > 0 && source[open - 1] == 'R') {
    const std::size_t paren = source.find('(', open);
    if (paren == std::string_view::npos) return source.size();
    const std::string closing = ")" + std::string(source.substr(open + 1, paren - open - 1)) + '"';
    const std::size_t end = source.find(closing, paren);
    return end == std::string_view::npos ? source.size() : end + closing.size();
  }
  for (std::size_t i = open + 1; i < source.size(); ++i) {
    if (source[i] == '\\') {
      ++i;
    } else if (source[i] == quote || source[i] == '\n') {
      return i + 1;
    }
  }
  return source.size();
}

std::size_t end_of_comment(std::string_view source, std::size_t begin) {
  const bool to_line_end = source[begin + 1] == '/';
  const std::size_t end = source.find(to_line_end ? "\n" : "*/", begin + 2);
  if (end == std::string_view::npos) return source.size();
  return to_line_end ? end : end + 2;
}

void blank(std::string& text, std::size_t begin, std::size_t end) {
  for (std::size_t i = begin; i < end; ++i) {
    if (text[i] != '\n') text[i] = ' ';
  }
}

/// The last token of `text`: a word or one punctuation character.
std::string_view last_token(std::string_view text) {
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  if (text.empty()) return {};
  std::size_t begin = text.size() - 1;
  while (is_word(text[begin]) && begin > 0 && is_word(text[begin - 1])) --begin;
  return text.substr(begin);
}

Identifier describe(std::string_view code, std::size_t begin, std::size_t end) {
  Identifier found;
  found.name = code.substr(begin, end - begin);
  std::string_view before = code.substr(0, begin);
  while (before.ends_with("::")) {
    before.remove_suffix(2);
    const std::string_view qualifier = last_token(before);
    const bool named = !before.empty() && !qualifier.empty() && is_word(before.back());
    if (!named) {
      found.global = found.qualifier.empty();
      break;
    }
    if (found.qualifier.empty()) found.qualifier = qualifier;
    before.remove_suffix(qualifier.size());
  }
  found.before = last_token(before);
  if (found.before == ">" && code.substr(0, begin).ends_with("->")) found.before = "->";
  found.after = code.substr(end);
  while (!found.after.empty() && is_space(found.after.front())) found.after.remove_prefix(1);
  return found;
}

}  // namespace

std::string without_comments(std::string_view source, StringLiterals literals) {
  std::string text(source);
  std::size_t i = 0;
  while (i < source.size()) {
    const bool comment = source.substr(i).starts_with("//") || source.substr(i).starts_with("/*");
    const bool digit_separator = source[i] == '\'' && i > 0 && is_word(source[i - 1]);
    if (comment) {
      const std::size_t end = end_of_comment(source, i);
      blank(text, i, end);
      i = end;
    } else if ((source[i] == '"' || source[i] == '\'') && !digit_separator) {
      const std::size_t end = end_of_literal(source, i);
      if (literals == StringLiterals::kBlank) blank(text, i, end);
      i = end;
    } else {
      ++i;
    }
  }
  return text;
}

std::vector<Identifier> identifiers_of(std::string_view code) {
  std::vector<Identifier> found;
  int line = 1;
  std::size_t i = 0;
  while (i < code.size()) {
    if (!is_word(code[i])) {
      if (code[i] == '\n') ++line;
      ++i;
      continue;
    }
    std::size_t end = i;
    while (end < code.size() && is_word(code[end])) ++end;
    if (std::isdigit(static_cast<unsigned char>(code[i])) == 0) {
      found.push_back(describe(code, i, end));
      found.back().line = line;
    }
    i = end;
  }
  return found;
}

}  // namespace linewright::architecture
