#include "linewright/base/files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <vector>

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

std::optional<std::string> read_file(const std::string& path, std::size_t most_bytes,
                                     std::string& reason) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    reason = "it is a folder";
    return std::nullopt;
  }
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) {
    reason = errno != 0 ? std::strerror(errno) : "unknown reason";
    return std::nullopt;
  }
  // By and by: a small file must not cost what the largest one would.
  std::string bytes;
  std::vector<char> chunk(std::size_t{1} << 16);
  while (stream && bytes.size() <= most_bytes) {
    const std::size_t wanted = std::min(chunk.size(), most_bytes + 1 - bytes.size());
    stream.read(chunk.data(), static_cast<std::streamsize>(wanted));
    bytes.append(chunk.data(), static_cast<std::size_t>(stream.gcount()));
  }
  return bytes;
}

std::string beside(const std::string& file, const std::string& other) {
  return (std::filesystem::path(file).parent_path() / other).lexically_normal().string();
}

std::string program_file() {
  std::error_code unknown;
  return std::filesystem::read_symlink("/proc/self/exe", unknown).string();
}

std::vector<std::string> shipped_folders(const std::string& name) {
  constexpr int kFoldersAbove = 4;
  std::vector<std::filesystem::path> places{name};
  std::filesystem::path program = program_file();
  for (int up = 0; up < kFoldersAbove && program.has_parent_path(); ++up) {
    program = program.parent_path();
    places.push_back(program / name);
  }
  std::vector<std::string> folders;
  for (const auto& place : places) {
    std::error_code ignored;
    if (std::filesystem::is_directory(place, ignored)) folders.push_back(place.string());
  }
  return folders;
}

}  // namespace linewright
