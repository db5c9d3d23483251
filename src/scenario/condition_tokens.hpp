#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace linewright::loading {

struct ConditionToken {
  enum class Kind : std::uint8_t { kName, kNumber, kSymbol, kWrong, kEnd };
  Kind kind = Kind::kEnd;
  std::string_view text;  ///< of kEnd: empty

  [[nodiscard]] bool is(std::string_view word) const {
    return (kind == Kind::kSymbol || kind == Kind::kName) && text == word;
  }
};

/// Splits a condition into names (with dots), numbers, symbols and a final kEnd. Whatever is none
/// of these is one kWrong token.
[[nodiscard]] std::vector<ConditionToken> condition_tokens(std::string_view text);

}  // namespace linewright::loading
