#include "experiment_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "linewright/base/diagnostic.hpp"
#include "linewright/base/files.hpp"

namespace linewright::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPaperTables = "tables.yaml";  ///< beside the experiments

/// What is in a folder, by name; empty when it is none.
std::vector<fs::path> entries_of(const std::string& folder) {
  std::vector<fs::path> entries;
  if (!fs::is_directory(folder)) return entries;
  for (const auto& entry : fs::directory_iterator(folder)) entries.push_back(entry.path());
  std::sort(entries.begin(), entries.end());
  return entries;
}

}  // namespace

std::vector<std::string> experiment_files(const std::string& what) {
  if (fs::is_regular_file(what)) return {what};
  std::vector<std::string> folders{what};
  std::vector<std::string> known;
  for (const std::string& shipped : shipped_folders("experiments")) {
    folders.push_back(shipped + "/" + what);
    for (const fs::path& entry : entries_of(shipped)) known.push_back(entry.filename().string());
  }
  for (const std::string& folder : folders) {
    std::vector<std::string> files;
    for (const fs::path& file : entries_of(folder)) {
      if (file.extension() != ".yaml" || file.filename() == kPaperTables) continue;
      files.push_back(file.string());
    }
    if (!files.empty()) return files;
  }
  throw ScenarioError({}, fmt::format("there are no experiments {}", in_quotes(what)),
                      known.empty() ? "name a file" : name_hint(what, known));
}

}  // namespace linewright::cli
