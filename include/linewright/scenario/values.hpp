#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "linewright/scenario/source_node.hpp"

namespace linewright::loading {

/// Decimal digits with an optional sign; no leading zero (YAML 1.1 would read an octal number).
[[nodiscard]] std::optional<std::int64_t> parse_integer(std::string_view text);
/// A finite decimal number.
[[nodiscard]] std::optional<double> parse_real(std::string_view text);

/// The value of `key` in a checked mapping; `otherwise` where it is absent or was reported.
[[nodiscard]] std::int32_t integer_or(const SourceNode& mapping, std::string_view key,
                                      std::int32_t otherwise);
[[nodiscard]] double real_or(const SourceNode& mapping, std::string_view key, double otherwise);
[[nodiscard]] bool boolean_or(const SourceNode& mapping, std::string_view key, bool otherwise);
[[nodiscard]] std::string text_or(const SourceNode& mapping, std::string_view key,
                                  std::string_view otherwise);

/// The spot of `key`'s value, or of the mapping when it has no such key.
[[nodiscard]] SourceMark mark_of(const SourceNode& mapping, std::string_view key);

}  // namespace linewright::loading
