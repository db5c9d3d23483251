#pragma once

#include <cstddef>
#include <string_view>

#include "linewright/scenario/source_node.hpp"

namespace linewright::loading {

/// Bytes of one file; values of one file, aliases and templates written out; nesting of one file.
inline constexpr std::size_t kMaxFileBytes = std::size_t{1} << 20;
inline constexpr std::size_t kMaxWeight = 200'000;
inline constexpr std::size_t kMaxDepth = 32;

/// Parses one YAML document. Reports what is wrong to `problems` and returns a broken node when
/// nothing could be read. Never throws on bad input.
[[nodiscard]] SourceNode read_yaml(std::string_view text, int file, Problems& problems);

/// Whether YAML 1.1 reads the word as a boolean although a person may mean a name: on, off, yes,
/// ...
[[nodiscard]] bool is_banned_word(std::string_view word);

}  // namespace linewright::loading
