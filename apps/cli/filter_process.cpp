#include "filter_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "common.hpp"

namespace linewright::cli {
namespace {

constexpr int kNotStarted = 127;
constexpr int kPollMilliseconds = 200;

/// The two ends of a pipe; what is open is closed in the end.
class Pipe {
 public:
  Pipe() { open_ = pipe2(ends_.data(), O_CLOEXEC) == 0; }
  ~Pipe() {
    close_end(0);
    close_end(1);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  [[nodiscard]] bool is_open() const { return open_; }
  [[nodiscard]] int reads() const { return ends_[0]; }
  [[nodiscard]] int writes() const { return ends_[1]; }
  void close_end(std::size_t end) {
    if (ends_[end] >= 0) close(ends_[end]);
    ends_[end] = -1;
  }

 private:
  std::array<int, 2> ends_{-1, -1};
  bool open_ = false;
};

/// Only calls that are safe behind fork().
[[noreturn]] void become(char* const* arguments, int in, int out, int error) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  setpgid(0, 0);  // Ctrl-C comes to this program, which passes it on
  dup2(in, STDIN_FILENO);
  dup2(out, STDOUT_FILENO);
  dup2(error, STDERR_FILENO);
  execvp(arguments[0], arguments);
  _exit(kNotStarted);
}

/// Text as it comes, cut into lines.
class Lines {
 public:
  explicit Lines(std::function<void(const std::string&)> on_line) : on_line_(std::move(on_line)) {}

  /// False: there is nothing more to come.
  bool read_from(int file) {
    std::array<char, 65536> chunk;
    const ssize_t count = read(file, chunk.data(), chunk.size());
    if (count < 0) return errno == EINTR;
    if (count == 0) {
      if (!rest_.empty()) on_line_(rest_);
      rest_.clear();
      return false;
    }
    rest_.append(chunk.data(), static_cast<std::size_t>(count));
    std::size_t begin = 0;
    for (std::size_t end = 0; (end = rest_.find('\n', begin)) != std::string::npos; begin = end + 1)
      on_line_(rest_.substr(begin, end - begin));
    rest_.erase(0, begin);
    return true;
  }

 private:
  std::function<void(const std::string&)> on_line_;
  std::string rest_;
};

/// A program that was started. None is left behind, whatever happens.
class Child {
 public:
  explicit Child(pid_t process) : process_(process) {}
  ~Child() {
    if (process_ <= 0) return;
    kill(process_, SIGTERM);
    wait_for_end();
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  int wait_for_end() {
    int status = 0;
    while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    process_ = -1;
    return status;
  }

 private:
  pid_t process_;
};

/// Writes and reads at once, so that neither program waits for the other for ever.
void exchange(pid_t process, Pipe& in, Pipe& out, Pipe& error, const std::string& input,
              Lines& lines, Lines& errors) {
  std::size_t written = 0;
  bool told = false;
  bool reading = true;
  bool complaining = true;
  while (reading || complaining) {
    if (interrupted().requested() && !told) {
      kill(process, SIGTERM);
      told = true;
    }
    const bool writing = written < input.size() && in.writes() >= 0;
    std::array<pollfd, 3> files{{{reading ? out.reads() : -1, POLLIN, 0},
                                 {complaining ? error.reads() : -1, POLLIN, 0},
                                 {writing ? in.writes() : -1, POLLOUT, 0}}};
    if (poll(files.data(), files.size(), kPollMilliseconds) < 0 && errno != EINTR) return;
    if (files[0].revents != 0) reading = lines.read_from(out.reads());
    if (files[1].revents != 0) complaining = errors.read_from(error.reads());
    if (files[2].revents == 0) continue;
    const ssize_t count = write(in.writes(), input.data() + written, input.size() - written);
    if (count > 0) written += static_cast<std::size_t>(count);
    const bool broken = count < 0 && errno != EAGAIN && errno != EINTR;
    if (written == input.size() || broken) in.close_end(1);
  }
}

}  // namespace

FilterResult run_filter(const std::vector<std::string>& words, const std::string& input,
                        const std::function<void(const std::string&)>& on_line) {
  FilterResult result;
  Pipe in;
  Pipe out;
  Pipe error;
  std::vector<std::string> copies = words;
  std::vector<char*> arguments;
  for (std::string& word : copies) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const pid_t process = in.is_open() && out.is_open() && error.is_open() ? fork() : -1;
  if (process == 0) become(arguments.data(), in.reads(), out.writes(), error.writes());
  if (process < 0) {
    result.last_error = std::strerror(errno);
    return result;
  }
  in.close_end(0);
  out.close_end(1);
  error.close_end(1);
  fcntl(in.writes(), F_SETFL, O_NONBLOCK);
  Child child(process);
  Lines lines(on_line);
  Lines errors([&](const std::string& line) {
    if (!line.empty()) result.last_error = line;
  });
  exchange(process, in, out, error, input, lines, errors);
  const int status = child.wait_for_end();
  result.success = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  if (WIFEXITED(status) && WEXITSTATUS(status) == kNotStarted && result.last_error.empty())
    result.last_error = "there is no such program";
  return result;
}

}  // namespace linewright::cli
