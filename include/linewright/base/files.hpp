#pragma once

#include <string>
#include <string_view>

namespace linewright {

/// Writes `text` to `path`, creating its folder: first beside it, then renamed, so that a reader
/// never sees half a file. Throws ScenarioError naming the file and the reason.
void write_file(const std::string& path, std::string_view text);

}  // namespace linewright
