#pragma once

#include <cstdint>
#include <fstream>
#include <string>
#include <string_view>

namespace linewright {

/// A file that grows at its end, in steps that are written whole or not at all. What is appended is
/// kept in memory until flush(). Every failure is a ScenarioError that names the file and the
/// reason; the file then ends where the last successful flush() left it. Not thread-safe.
class LogFile {
 public:
  /// A new file, or an old one emptied; makes its folder.
  [[nodiscard]] static LogFile create(const std::string& path);
  /// An old file, cut back to its first `size` bytes: what a resumed run had written at its
  /// checkpoint. An error when the file is shorter than that.
  [[nodiscard]] static LogFile reopen(const std::string& path, std::uint64_t size);

  /// Unflushed bytes are lost: call flush() where a failure can be reported.
  ~LogFile() = default;
  LogFile(LogFile&&) = default;
  LogFile& operator=(LogFile&&) = default;

  void append(std::string_view bytes) { pending_ += bytes; }
  /// Writes what was appended. After an error it is still pending and may be flushed again.
  void flush();
  /// Bytes of the file once everything appended so far is flushed.
  [[nodiscard]] std::uint64_t size() const { return written_ + pending_.size(); }
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  LogFile(std::string path, std::uint64_t size);
  void open();

  std::string path_;
  std::uint64_t written_ = 0;
  std::string pending_;
  std::ofstream stream_;
};

}  // namespace linewright
