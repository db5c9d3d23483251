#include "linewright/training/log_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

#include "linewright/base/diagnostic.hpp"

namespace linewright {
namespace {

[[noreturn]] void fail(const std::string& path, const std::string& reason) {
  throw ScenarioError(path, fmt::format("cannot be written: {}", reason),
                      "name a file in a folder that you may write to, on a disk with room");
}

std::string reason_of(int error) {
  return error != 0 ? std::strerror(error) : "the folder is not writable or the disk is full";
}

}  // namespace

LogFile::LogFile(std::string path, std::uint64_t size) : path_(std::move(path)), written_(size) {}

void LogFile::open() {
  std::error_code error;
  if (std::filesystem::is_directory(path_, error)) fail(path_, "it is a folder");
  errno = 0;
  stream_.open(path_, std::ios::binary | std::ios::app);
  if (!stream_) fail(path_, reason_of(errno));
}

LogFile LogFile::create(const std::string& path) {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  if (!folder.empty()) std::filesystem::create_directories(folder, error);
  if (error) fail(path, error.message());
  if (std::filesystem::is_regular_file(path, error)) {
    std::filesystem::resize_file(path, 0, error);
    if (error) fail(path, error.message());
  }
  LogFile file(path, 0);
  file.open();
  return file;
}

LogFile LogFile::reopen(const std::string& path, std::uint64_t size) {
  std::error_code error;
  const std::uint64_t there = std::filesystem::file_size(path, error);
  if (error) fail(path, error.message());
  if (there < size) {
    throw ScenarioError(path, fmt::format("has {} bytes, but the run had written {}", there, size),
                        "the file was changed; start the run anew");
  }
  if (there > size) std::filesystem::resize_file(path, size, error);
  if (error) fail(path, error.message());
  LogFile file(path, size);
  file.open();
  return file;
}

void LogFile::flush() {
  if (pending_.empty()) return;
  errno = 0;
  stream_.write(pending_.data(), static_cast<std::streamsize>(pending_.size()));
  stream_.flush();
  if (stream_) {
    written_ += pending_.size();
    pending_.clear();
    return;
  }
  const std::string reason = reason_of(errno);
  // Nothing half-written stays, and the stream can be used again once there is room.
  stream_.close();
  stream_.clear();
  std::error_code error;
  if (std::filesystem::is_regular_file(path_, error)) {
    std::filesystem::resize_file(path_, written_, error);
  }
  stream_.open(path_, std::ios::binary | std::ios::app);
  fail(path_, reason);
}

}  // namespace linewright
