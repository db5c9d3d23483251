#include "folder_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "linewright/base/diagnostic.hpp"

namespace linewright::trainer {

FolderLock::FolderLock(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  const std::string path = folder + "/lock";
  file_ = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (file_ < 0) {
    throw ScenarioError(path, fmt::format("cannot be written: {}", std::strerror(errno)),
                        "name another folder (--out)");
  }
  if (flock(file_, LOCK_EX | LOCK_NB) == 0) return;
  const int reason = errno;
  close(file_);
  if (reason != EWOULDBLOCK) {
    throw ScenarioError(path, fmt::format("cannot be locked: {}", std::strerror(reason)),
                        "name another folder (--out)");
  }
  throw ScenarioError(folder, "another training run is writing into this folder",
                      "wait for it, stop it, or name another folder (--out)");
}

FolderLock::~FolderLock() { close(file_); }

}  // namespace linewright::trainer
