#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace linewright::architecture {

enum class StringLiterals { kKeep, kBlank };

/// `source` with every comment, and with kBlank also what string and character literals say,
/// replaced by spaces. Line breaks stay, so that lines keep their numbers.
std::string without_comments(std::string_view source, StringLiterals literals);

/// An identifier of C++ code and what surrounds it.
struct Identifier {
  std::string_view name;
  int line = 0;                ///< from 1
  std::string_view qualifier;  ///< `std` in `std::exit`; empty if there is none
  bool global = false;         ///< written `::name`
  std::string_view before;     ///< the token before, qualifiers excluded
  std::string_view after;      ///< the rest of the text, leading spaces removed
};

/// All identifiers and keywords of `code`, which must be free of comments and literals. The views
/// point into `code`.
std::vector<Identifier> identifiers_of(std::string_view code);

}  // namespace linewright::architecture
