#pragma once

#include <string>
#include <vector>

namespace linewright::cli {

/// The experiments that are asked for: a file, a folder, or the name of a folder of experiments/.
/// In the order of their names. Throws ScenarioError when there are none.
[[nodiscard]] std::vector<std::string> experiment_files(const std::string& what);

}  // namespace linewright::cli
