#pragma once

#include <string>

namespace linewright::trainer {

/// Keeps a run's folder for this process: two runs that write into one folder would spoil both. The
/// system gives the lock back when the process ends, however it ends.
class FolderLock {
 public:
  /// Creates the folder. Throws ScenarioError when another process has it, and when it cannot be
  /// written into.
  explicit FolderLock(const std::string& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int file_ = -1;
};

}  // namespace linewright::trainer
