#pragma once

#include <sys/types.h>

#include <cstdint>
#include <string>
#include <vector>

#include "tests/cli_support.hpp"

// `linewright view` as a running server, and clients that speak to it as they like.
#ifdef LINEWRIGHT_CLI

namespace linewright::testing {

/// A folder of this test with a page where the command line tool looks for it.
class PageFolder {
 public:
  PageFolder();
  ~PageFolder();
  PageFolder(const PageFolder&) = delete;
  PageFolder& operator=(const PageFolder&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] std::string file(const std::string& name) const { return path_ + "/" + name; }
  void write(const std::string& name, const std::string& text) const;

 private:
  std::string path_;
};

/// The page of a PageFolder.
extern const char* const kPage;

/// A command of the tool that goes on in a folder until it is told to end.
class RunningTool {
 public:
  RunningTool(const std::string& folder, const std::vector<std::string>& arguments);
  ~RunningTool();
  RunningTool(const RunningTool&) = delete;
  RunningTool& operator=(const RunningTool&) = delete;

  /// The port of the first address that it prints, to either stream; 0: it prints none.
  [[nodiscard]] std::uint16_t port() const { return port_; }
  /// Sends the signal.
  void signal(int number) const;
  /// Waits for its end; its exit code, -1 when a signal ended it.
  int wait();
  /// What it has written so far, both streams.
  [[nodiscard]] std::string output() const;

 private:
  pid_t pid_ = -1;
  std::string output_file_;
  std::uint16_t port_ = 0;
};

/// A connection to 127.0.0.1.
class Client {
 public:
  explicit Client(std::uint16_t port);
  ~Client();
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  [[nodiscard]] bool connected() const { return socket_ >= 0; }
  /// False when the other end has closed.
  bool send(const std::string& bytes) const;
  /// Says that nothing more will be sent.
  void end_sending() const;
  /// What comes until the other end closes, but for at most so long.
  [[nodiscard]] std::string receive(int milliseconds = 10'000) const;
  /// The next bytes that come, once there are any; empty: none for so long, or the end.
  [[nodiscard]] std::string receive_some(int milliseconds) const;

 private:
  int socket_ = -1;
};

/// The whole answer to a request with these lines, Host and `Connection: close` added.
std::string get(std::uint16_t port, const std::string& path, const std::string& more = {});

/// The body of an answer, put together when it came in pieces.
std::string body_of(const std::string& answer);

}  // namespace linewright::testing

#endif
