#include "train_jobs.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "common.hpp"
#include "linewright/base/diagnostic.hpp"
#include "linewright/base/files.hpp"

namespace linewright::cli {
namespace {

namespace fs = std::filesystem;

constexpr useconds_t kPollMicroseconds = 200'000;

/// A job that is running.
struct Running {
  const TrainJob* job;
  pid_t process;
};

std::string log_of(const TrainJob& job) { return job.folder() + ".log"; }

std::vector<std::string> words_of(const TrainJob& job) {
  std::vector<std::string> words{"linewright-train", "--algo", job.algorithm, "--scenario",
                                 job.scenario, "--seed", std::to_string(job.seed), "--out", job.out,
                                 // One core each; the result does not depend on it.
                                 "--set", "run.threads=1", "--quiet"};
  for (const std::string& option : job.set) words.insert(words.end(), {"--set", option});
  if (fs::exists(job.folder() + "/checkpoint.bin")) words.emplace_back("--resume");
  return words;
}

/// What a run does before it becomes the trainer; only calls that are safe behind fork().
[[noreturn]] void become(const char* program, char* const* arguments, int log) {
  // Should this program be killed, the run writes a checkpoint and ends, too: none goes on unseen.
  prctl(PR_SET_PDEATHSIG, SIGINT);
  // A group of its own: Ctrl-C comes to this program, which passes it on once.
  setpgid(0, 0);
  dup2(log, STDOUT_FILENO);
  dup2(log, STDERR_FILENO);
  execv(program, arguments);
  constexpr int kNotStarted = 127;
  _exit(kNotStarted);
}

pid_t start(const TrainJob& job, const std::string& program) {
  fs::create_directories(job.out);
  std::vector<std::string> words = words_of(job);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const int log = open(log_of(job).c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (log < 0) throw ScenarioError(log_of(job), std::strerror(errno), "");
  const pid_t process = fork();
  if (process == 0) become(program.c_str(), arguments.data(), log);
  const int reason = errno;
  close(log);
  if (process < 0) {
    throw ScenarioError(program, fmt::format("cannot be started: {}", std::strerror(reason)), "");
  }
  return process;
}

/// Updates that the run has made, of its progress.csv; 0 before the first row.
std::size_t updates_of(const TrainJob& job) {
  std::ifstream in(job.folder() + "/progress.csv");
  std::string last;
  for (std::string line; std::getline(in, line);) {
    if (!line.empty()) last = line;
  }
  return static_cast<std::size_t>(std::strtoull(last.c_str(), nullptr, 10));
}

std::string last_words(const TrainJob& job) {
  std::ifstream in(log_of(job));
  std::string last;
  for (std::string line; std::getline(in, line);) {
    if (line.find("error") != std::string::npos || last.empty()) last = line;
  }
  return last;
}

/// Starts, watches and ends the runs.
class Jobs {
 public:
  Jobs(const std::vector<TrainJob>& jobs, std::size_t cores)
      : cores_(std::max<std::size_t>(1, cores)), bar_("training") {
    for (const TrainJob& job : jobs) {
      if (!job.is_done()) waiting_.push_back(&job);
    }
    total_ = waiting_.size();
  }

  bool run() {
    if (waiting_.empty()) return true;
    program_ = trainer_program();
    while (true) {
      if (interrupted().requested() || !failure_.empty()) stop();
      while (running_.size() < cores_ && next_ < waiting_.size()) {
        running_.push_back({waiting_[next_], start(*waiting_[next_], program_)});
        ++next_;
      }
      if (running_.empty()) break;
      usleep(kPollMicroseconds);
      collect();
      show();
    }
    if (!failure_.empty()) throw ScenarioError({}, failure_, "the runs that are done are kept");
    return !interrupted().requested();
  }

 private:
  void stop() {
    next_ = waiting_.size();
    if (stopped_) return;
    stopped_ = true;
    for (const Running& run : running_) kill(run.process, SIGINT);
  }

  void collect() {
    std::erase_if(running_, [&](const Running& run) {
      int status = 0;
      if (waitpid(run.process, &status, WNOHANG) != run.process) return false;
      ++done_;
      if (!run.job->is_done() && !interrupted().requested() && failure_.empty()) {
        failure_ =
            fmt::format("training {} with seed {} failed: {} (all of it in {})", run.job->algorithm,
                        run.job->seed, last_words(*run.job), log_of(*run.job));
      }
      return true;
    });
  }

  void show() {
    std::string note;
    for (const Running& run : running_) {
      note +=
          fmt::format(" {}-s{}: update {}", run.job->name(), run.job->seed, updates_of(*run.job));
    }
    bar_.update(done_, total_, note);
  }

  std::size_t cores_;
  ProgressBar bar_;
  std::string program_;
  std::vector<const TrainJob*> waiting_;
  std::vector<Running> running_;
  std::size_t next_ = 0;
  std::size_t done_ = 0;
  std::size_t total_ = 0;
  bool stopped_ = false;
  std::string failure_;
};

}  // namespace

std::string TrainJob::name() const { return fs::path(algorithm).stem().string(); }

std::string TrainJob::folder() const { return fmt::format("{}/{}-s{}", out, name(), seed); }

std::string TrainJob::policy() const {
  return folder() + (has_best() ? "/best.safetensors" : "/final.safetensors");
}

bool TrainJob::has_best() const { return fs::exists(folder() + "/best.safetensors"); }

bool TrainJob::is_done() const { return fs::exists(folder() + "/final.safetensors"); }

bool run_train_jobs(const std::vector<TrainJob>& jobs, std::size_t cores) {
  return Jobs(jobs, cores).run();
}

std::string trainer_program() {
  std::error_code ignored;
  const fs::path program = fs::path(program_file()).parent_path() / "linewright-train";
  if (!fs::exists(program, ignored)) {
    throw ScenarioError(program.string(), "this build has no trainer: LibTorch was not found",
                        "install libtorch-dev (make demo does) and build again; trained policies "
                        "work without it");
  }
  return program.string();
}

}  // namespace linewright::cli
