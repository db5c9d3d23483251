#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace linewright {

/// Writes `text` to `path`, creating its folder: first beside it, then renamed, so that a reader
/// never sees half a file. Throws ScenarioError naming the file and the reason.
void write_file(const std::string& path, std::string_view text);

/// The bytes of a file, but at most `most_bytes` + 1, so that no device file can fill the memory
/// and the caller sees that there were too many. None when it cannot be read; `reason` then says
/// why.
[[nodiscard]] std::optional<std::string> read_file(const std::string& path, std::size_t most_bytes,
                                                   std::string& reason);

/// `other`, as named in `file`, in the way the user would name it: relative to the folder of
/// `file`.
[[nodiscard]] std::string beside(const std::string& file, const std::string& other);

/// This program's own file; empty when the system does not tell.
[[nodiscard]] std::string program_file();

/// Where a folder of the repository or the installation may be: here, then beside the program and
/// in the folders above it. Only those that are there.
[[nodiscard]] std::vector<std::string> shipped_folders(const std::string& name);

}  // namespace linewright
