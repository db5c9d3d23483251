#include "tests/view_support.hpp"

#ifdef LINEWRIGHT_CLI

#include <arpa/inet.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>

namespace linewright::testing {
namespace {

using Clock = std::chrono::steady_clock;

std::string unique_name(const char* what) {
  static std::atomic<int> counter = 0;
  return temporary(fmt::format("{}_{}", what, counter++));
}

std::uint16_t port_in(const std::string& text) {
  const std::string before = "http://127.0.0.1:";
  const std::size_t at = text.find(before);
  if (at == std::string::npos || text.find('/', at + before.size()) == std::string::npos) return 0;
  return static_cast<std::uint16_t>(std::atoi(text.c_str() + at + before.size()));
}

}  // namespace

const char* const kPage =
    "<!doctype html><title>page</title>"
    "<script type=\"application/json\" id=\"linewright-logs\">null</script><p>the page</p>";

PageFolder::PageFolder() : path_(unique_name("view")) {
  std::filesystem::create_directories(path_ + "/web");
  write("web/linewright-view.html", kPage);
}

PageFolder::~PageFolder() { std::filesystem::remove_all(path_); }

void PageFolder::write(const std::string& name, const std::string& text) const {
  std::ofstream(file(name), std::ios::binary) << text;
}

RunningTool::RunningTool(const std::string& folder, const std::vector<std::string>& arguments)
    : output_file_(unique_name("output")) {
  std::vector<std::string> words{LINEWRIGHT_CLI};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  pid_ = fork();
  if (pid_ == 0) {
    const int out = open(output_file_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND, 0600);
    dup2(out, STDOUT_FILENO);
    dup2(out, STDERR_FILENO);
    if (chdir(folder.c_str()) == 0) execv(pointers[0], pointers.data());
    _exit(127);
  }
  const auto patience = Clock::now() + std::chrono::seconds(60);
  while (port_ == 0 && Clock::now() < patience) {
    siginfo_t ended{};
    waitid(P_PID, static_cast<id_t>(pid_), &ended, WEXITED | WNOHANG | WNOWAIT);
    port_ = port_in(output());
    if (ended.si_pid != 0) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

RunningTool::~RunningTool() {
  if (pid_ > 0) {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  std::filesystem::remove(output_file_);
}

void RunningTool::signal(int number) const { kill(pid_, number); }

int RunningTool::wait() {
  int status = 0;
  waitpid(pid_, &status, 0);
  pid_ = -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::string RunningTool::output() const { return read_file(output_file_); }

Client::Client(std::uint16_t port) : socket_(socket(AF_INET, SOCK_STREAM, 0)) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    close(socket_);
    socket_ = -1;
  }
}

Client::~Client() {
  if (socket_ >= 0) close(socket_);
}

bool Client::send(const std::string& bytes) const {
  std::size_t sent = 0;
  while (sent < bytes.size()) {
    const ssize_t n = ::send(socket_, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
    if (n <= 0) return false;
    sent += static_cast<std::size_t>(n);
  }
  return true;
}

void Client::end_sending() const { shutdown(socket_, SHUT_WR); }

std::string Client::receive_some(int milliseconds) const {
  pollfd waiting{socket_, POLLIN, 0};
  if (poll(&waiting, 1, milliseconds) <= 0) return {};
  std::array<char, 65536> buffer{};
  const ssize_t n = recv(socket_, buffer.data(), buffer.size(), 0);
  return n > 0 ? std::string(buffer.data(), static_cast<std::size_t>(n)) : std::string();
}

std::string Client::receive(int milliseconds) const {
  const auto end = Clock::now() + std::chrono::milliseconds(milliseconds);
  std::string all;
  while (Clock::now() < end) {
    const std::string part = receive_some(milliseconds);
    if (part.empty()) break;
    all += part;
  }
  return all;
}

std::string get(std::uint16_t port, const std::string& path, const std::string& more) {
  const Client client(port);
  client.send(fmt::format("GET {} HTTP/1.1\r\nHost: 127.0.0.1:{}\r\nConnection: close\r\n{}\r\n",
                          path, port, more));
  return client.receive();
}

std::string body_of(const std::string& answer) {
  const std::size_t blank = answer.find("\r\n\r\n");
  if (blank == std::string::npos) return {};
  const std::string body = answer.substr(blank + 4);
  if (answer.substr(0, blank).find("Transfer-Encoding: chunked") == std::string::npos) return body;
  std::string joined;
  for (std::size_t at = 0; at < body.size();) {
    const std::size_t size = std::strtoul(body.c_str() + at, nullptr, 16);
    at = body.find("\r\n", at) + 2;
    if (size == 0 || at > body.size()) break;
    joined += body.substr(at, size);
    at += size + 2;
  }
  return joined;
}

}  // namespace linewright::testing

#endif
