#include "train.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>

#include "folder_lock.hpp"
#include "linewright/base/diagnostic.hpp"
#include "linewright/base/files.hpp"
#include "linewright/learning/runtime.hpp"
#include "linewright/learning/trainer.hpp"
#include "linewright/scenario/load.hpp"
#include "linewright_commit.hpp"

namespace linewright::trainer {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double wall_time_s() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

/// A file as it is named, or one of the folder algorithms/ by its stem.
std::string options_file(const std::string& name, const char* what) {
  if (name.empty() || fs::exists(name)) return name;
  std::vector<std::string> known;
  for (const std::string& folder : shipped_folders("algorithms")) {
    const fs::path file = fs::path(folder) / (name + ".yaml");
    if (fs::exists(file)) return file.string();
    if (!known.empty()) continue;
    for (const auto& entry : fs::directory_iterator(folder)) {
      known.push_back(entry.path().stem().string());
    }
    std::sort(known.begin(), known.end());
  }
  throw ScenarioError({}, fmt::format("there is no {} '{}'", what, name),
                      known.empty() ? "name a file" : name_hint(name, known));
}

std::string short_time(double seconds) {
  const auto whole = static_cast<long>(seconds);
  return whole < 3600 ? fmt::format("{}:{:02}", whole / 60, whole % 60)
                      : fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

/// Lines of progress: over one another for a person, every half minute for a file.
class Display {
 public:
  Display(std::string name, bool quiet)
      : name_(std::move(name)), person_(isatty(STDERR_FILENO) == 1), quiet_(quiet) {}

  void update(const TrainingStatus& status) {
    if (!first_) first_ = status;
    if (status.latest && (!shown_ || shown_ != status.latest->update)) show_evaluation(status);
    const double now = seconds_since(start_);
    if (quiet_ || now - drawn_s_ < (person_ ? 0.5 : 30.0)) return;
    drawn_s_ = now;
    const auto done = static_cast<double>(status.updates - first_->updates);
    const auto left = static_cast<double>(status.most_updates - status.updates);
    const std::string eta = done > 0.0 ? short_time(now / done * left) : "?";
    const std::string line = fmt::format(
        "{}: update {}/{}  {:.0f}/s  episodes {}  decisions {:.0f}/s  makespan {:.0f}  success "
        "{:.2f}  loss {:.4f}  left {}",
        name_, status.updates, status.most_updates, done / now, status.episodes,
        static_cast<double>(status.decisions - first_->decisions) / now, status.makespan,
        status.success, status.loss, eta);
    fmt::print(stderr, "{}{}{}", person_ ? "\r\033[K" : "", line, person_ ? "" : "\n");
    std::fflush(stderr);
  }

  void end() const {
    if (person_ && !quiet_) fmt::print(stderr, "\r\033[K");
  }

  [[nodiscard]] double seconds() const { return seconds_since(start_); }

 private:
  void show_evaluation(const TrainingStatus& status) {
    shown_ = status.latest->update;
    if (quiet_) return;
    const bool best = status.best && status.best->update == status.latest->update;
    fmt::print(stderr, "{}{}: {} evaluation at update {}: makespan {:.1f}, success {:.3f}{}\n",
               person_ ? "\r\033[K" : "", name_, short_time(seconds_since(start_)),
               status.latest->update, status.latest->makespan, status.latest->success,
               best ? "  (best so far: kept)" : "");
  }

  std::string name_;
  bool person_;
  bool quiet_;
  Clock::time_point start_ = Clock::now();
  double drawn_s_ = 0.0;
  std::optional<TrainingStatus> first_;
  std::optional<std::int64_t> shown_;
};

int train_one(const TrainArguments& arguments, const TrainingOptions& options,
              const Scenario& scenario, std::uint64_t seed) {
  const std::string name = fmt::format("{}-s{}", options.algorithm.name, seed);
  Display display(name, arguments.quiet);
  TrainingRun run{.scenario = &scenario,
                  .options = options,
                  .seed = seed,
                  .folder = arguments.out + "/" + name,
                  .resume = arguments.resume,
                  .metadata = {{"version", LINEWRIGHT_VERSION}, {"commit", LINEWRIGHT_COMMIT}}};
  const FolderLock lock(run.folder);
  const TrainingResult result =
      train(run, {.progress = [&](const TrainingStatus& status) { display.update(status); },
                  .wall_time_s = wall_time_s,
                  .cancel = &interrupted()});
  display.end();
  const TrainingStatus& status = result.status;
  fmt::print("{}: {} after {} updates, {} decisions, {} episodes in {}\n", name,
             result.finished ? "trained" : "interrupted (resume with --resume)", status.updates,
             status.decisions, status.episodes, short_time(display.seconds()));
  if (status.best) {
    fmt::print("{}: best evaluation at update {}: makespan {:.1f}, every run successful: {}\n",
               name, status.best->update, status.best->makespan, result.best_policy);
  } else {
    fmt::print("{}: no evaluation had every run succeed, so no best policy was kept\n", name);
  }
  return result.finished ? 0 : 130;
}

}  // namespace

CancelToken& interrupted() {
  static CancelToken token;
  return token;
}

void add_options(CLI::App& app, TrainArguments& arguments) {
  app.add_option("--algo", arguments.algorithm,
                 "Algorithm: a name of the folder algorithms/ or a file")
      ->capture_default_str();
  app.add_option("--preset", arguments.preset, "Laid on the algorithm: a name or a file (paper)");
  app.add_option("--scenario,scenario", arguments.scenario, "Scenario file")->required();
  app.add_option("--set", arguments.settings, "Override an option: group.key=value");
  app.add_option("--seed", arguments.seeds, "One or more seeds: 1,2,3")->delimiter(',');
  app.add_option("--out", arguments.out, "Folder for the results: OUT/ALGORITHM-sSEED")
      ->capture_default_str();
  app.add_flag("--resume", arguments.resume, "Go on from the folder's checkpoint");
  app.add_flag("--quiet", arguments.quiet, "Show no progress");
}

int run(const TrainArguments& arguments) {
  const TrainingOptions options =
      load_training_options(options_file(arguments.algorithm, "algorithm"),
                            options_file(arguments.preset, "preset"), arguments.settings);
  const Scenario scenario = load_scenario(arguments.scenario, {.cancel = &interrupted()});
  for (const Diagnostic& warning : scenario.warnings)
    fmt::print(stderr, "{}\n", to_string(warning));
  const LearningRuntime runtime = prepare_learning(static_cast<std::size_t>(options.run.threads));
  if (!arguments.quiet) {
    fmt::print(stderr, "LibTorch {} on {}, {} threads, matrices by {}\n", runtime.torch_version,
               runtime.device, runtime.threads, runtime.blas);
  }
  if (runtime.slow_blas) {
    fmt::print(stderr,
               "warning: LibTorch runs on the reference BLAS, 10 to 20 times slower than "
               "necessary\n  hint: apt-get install libopenblas0-openmp\n");
  }
  int code = 0;
  for (const std::uint64_t seed : arguments.seeds) {
    code = std::max(code, train_one(arguments, options, scenario, seed));
    if (interrupted().requested()) break;
  }
  return code;
}

}  // namespace linewright::trainer
