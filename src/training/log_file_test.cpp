#include "linewright/training/log_file.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <string>
#include <utility>

#include "linewright/base/diagnostic.hpp"
#include "linewright/base/files.hpp"

namespace linewright {
namespace {

std::string temporary(const std::string& name) {
  return testing::TempDir() + "linewright_log_file_" +
         testing::UnitTest::GetInstance()->current_test_info()->name() + "/" + name;
}

std::string content_of(const std::string& path) {
  std::string reason;
  return read_file(path, 1 << 20, reason).value_or("unreadable: " + reason);
}

template <class Action>
std::string complaint_of(const Action& action) {
  try {
    action();
  } catch (const ScenarioError& error) {
    return error.what();
  }
  return "";
}

/// While it lives, no file of this process can grow beyond so many bytes.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    old_handler_ = std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &old_);
    rlimit limit = old_;
    limit.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &old_);
    std::signal(SIGXFSZ, old_handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit old_{};
  void (*old_handler_)(int) = nullptr;
};

TEST(LogFile, KeepsWhatWasFlushedInOrder) {
  const std::string path = temporary("a.log");
  LogFile file = LogFile::create(path);
  file.append("one ");
  file.append("two ");
  EXPECT_EQ(content_of(path), "");
  EXPECT_EQ(file.size(), 8U);
  file.flush();
  EXPECT_EQ(content_of(path), "one two ");
  LogFile moved = std::move(file);
  moved.append("three");
  moved.flush();
  EXPECT_EQ(content_of(path), "one two three");
  EXPECT_EQ(moved.size(), 13U);
}

TEST(LogFile, CreatingEmptiesAnOldFile) {
  const std::string path = temporary("a.log");
  write_file(path, "old text");
  LogFile file = LogFile::create(path);
  file.append("new");
  file.flush();
  EXPECT_EQ(content_of(path), "new");
}

TEST(LogFile, ReopeningCutsBackToTheCheckpoint) {
  const std::string path = temporary("a.log");
  write_file(path, "kept lost");
  LogFile file = LogFile::reopen(path, 5);
  EXPECT_EQ(file.size(), 5U);
  file.append("again");
  file.flush();
  EXPECT_EQ(content_of(path), "kept again");
}

TEST(LogFile, AFileThatLostBytesIsNotContinued) {
  const std::string path = temporary("a.log");
  write_file(path, "short");
  EXPECT_NE(complaint_of([&] { (void)LogFile::reopen(path, 6); }).find("has 5 bytes"),
            std::string::npos);
  EXPECT_NE(complaint_of([&] { (void)LogFile::reopen(path + ".none", 0); }).find("No such file"),
            std::string::npos);
  EXPECT_EQ(content_of(path), "short");
}

TEST(LogFile, FoldersThatCannotBeWrittenAreNamed) {
  const std::string path = temporary("file");
  write_file(path, "x");
  const std::string below = path + "/deeper/a.log";
  EXPECT_NE(complaint_of([&] { (void)LogFile::create(below); }).find(below + ": error: cannot be"),
            std::string::npos);
  const std::string folder = std::filesystem::path(path).parent_path().string();
  EXPECT_NE(complaint_of([&] { (void)LogFile::create(folder); }).find("it is a folder"),
            std::string::npos);
}

TEST(LogFile, AFullDeviceIsReported) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP();
  LogFile file = LogFile::create("/dev/full");
  file.append("x");
  const std::string complaint = complaint_of([&] { file.flush(); });
  EXPECT_NE(complaint.find("/dev/full: error: cannot be written: No space"), std::string::npos)
      << complaint;
}

TEST(LogFile, NothingHalfWrittenStaysWhenThereIsNoRoom) {
  const std::string path = temporary("a.log");
  LogFile file = LogFile::create(path);
  file.append("first;");
  file.flush();
  const std::string large(200'000, 'x');
  file.append(large);
  {
    const FileSizeLimit limit(100'000);
    EXPECT_NE(complaint_of([&] { file.flush(); }), "");
    EXPECT_EQ(content_of(path), "first;");
    EXPECT_NE(complaint_of([&] { file.flush(); }), "");
    EXPECT_EQ(content_of(path), "first;");
  }
  file.flush();  // there is room again
  EXPECT_EQ(content_of(path), "first;" + large);
}

}  // namespace
}  // namespace linewright
