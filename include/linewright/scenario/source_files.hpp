#pragma once

#include <string>

#include "linewright/scenario/source_node.hpp"

namespace linewright::loading {

/// Reads `file` and, below it, the files it `extends`; returns the merged tree without the key
/// `extends`, or a broken node when a file could not be read. Never throws on bad input.
[[nodiscard]] SourceNode read_files(const std::string& file, Problems& problems);

/// `over` laid on `base`: mappings key by key, everything else replaced, null removes the key. Keys
/// keep the order of `base`; new ones follow.
[[nodiscard]] SourceNode merge(SourceNode base, SourceNode over, Problems& problems);

}  // namespace linewright::loading
