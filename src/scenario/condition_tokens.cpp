#include "condition_tokens.hpp"

#include <algorithm>
#include <array>
#include <cctype>

namespace linewright::loading {
namespace {

constexpr std::string_view kSpaces = " \t\r\n";

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }
bool in_name(char c) { return is_letter(c) || is_digit(c) || c == '_' || c == '.'; }

std::size_t symbol_length(std::string_view text) {
  // Longer symbols first: `<=` must not be read as `<`.
  static constexpr std::array<std::string_view, 12> kSymbols = {"==", "!=", "<=", ">=", "<", ">",
                                                                "=",  "+",  "-",  "*",  "(", ")"};
  const auto found = std::find_if(kSymbols.begin(), kSymbols.end(), [&](std::string_view symbol) {
    return text.starts_with(symbol);
  });
  return found == kSymbols.end() ? 0 : found->size();
}

template <class Predicate>
std::size_t length_while(std::string_view text, Predicate predicate) {
  const auto end = std::find_if_not(text.begin(), text.end(), predicate);
  return static_cast<std::size_t>(end - text.begin());
}

ConditionToken first_token(std::string_view text) {
  using Kind = ConditionToken::Kind;
  if (is_letter(text.front())) return {Kind::kName, text.substr(0, length_while(text, in_name))};
  if (is_digit(text.front())) {
    // `3rd` is one wrong token, not a number and a name.
    const std::size_t length = length_while(text, in_name);
    const bool is_number = length == length_while(text, is_digit);
    return {is_number ? Kind::kNumber : Kind::kWrong, text.substr(0, length)};
  }
  const std::size_t length = symbol_length(text);
  if (length > 0) return {Kind::kSymbol, text.substr(0, length)};
  const std::size_t end = text.find_first_of(kSpaces);
  return {Kind::kWrong, text.substr(0, end)};
}

}  // namespace

std::vector<ConditionToken> condition_tokens(std::string_view text) {
  std::vector<ConditionToken> tokens;
  while (true) {
    const std::size_t start = text.find_first_not_of(kSpaces);
    if (start == std::string_view::npos) break;
    text.remove_prefix(start);
    tokens.push_back(first_token(text));
    text.remove_prefix(tokens.back().text.size());
  }
  tokens.push_back({ConditionToken::Kind::kEnd, {}});
  return tokens;
}

}  // namespace linewright::loading
