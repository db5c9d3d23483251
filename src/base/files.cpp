#include "linewright/base/files.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <system_error>

#include "linewright/base/diagnostic.hpp"

namespace linewright {

void write_file(const std::string& path, std::string_view text) {
  const auto fail = [&](const std::string& why) {
    throw ScenarioError(path, fmt::format("cannot be written: {}", why),
                        "name a file in a folder that you may write to");
  };
  std::error_code error;
  const std::filesystem::path target(path);
  if (target.has_parent_path()) std::filesystem::create_directories(target.parent_path(), error);
  if (error) fail(error.message());
  if (std::filesystem::is_directory(target, error)) fail("it is a folder");
  const std::string partial = path + ".partial";
  {
    std::ofstream out(partial, std::ios::binary);
    out << text;
    out.flush();
    if (!out) {
      std::filesystem::remove(partial, error);
      fail("the folder is not writable or the disk is full");
    }
  }
  std::filesystem::rename(partial, target, error);
  if (error) fail(error.message());
}

}  // namespace linewright
