#include <fmt/format.h>
#include <malloc.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include "linewright/base/diagnostic.hpp"
#include "linewright/base/files.hpp"
#include "train.hpp"

namespace {

void on_signal(int signal) {
  std::signal(signal, SIG_DFL);  // a second Ctrl-C ends the program at once
  linewright::trainer::interrupted().request();
}

/// OpenMP reads its settings when the program is loaded. Waiting threads that spin make an update
/// many times slower as soon as another process wants a core; so, if nobody chose, they sleep.
void choose_waiting(char** argv) {
  if (std::getenv("OMP_WAIT_POLICY") != nullptr) return;
  setenv("OMP_WAIT_POLICY", "passive", 1);
  execv(linewright::program_file().c_str(), argv);  // goes on below if that is not possible
}

/// Big tensors stay with the program instead of going back to the system after every operation.
void keep_memory() {
  mallopt(M_MMAP_THRESHOLD, 1 << 30);
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
  mallopt(M_TOP_PAD, 64 << 20);
}

}  // namespace

int main(int argc, char** argv) {
  using namespace linewright;
  choose_waiting(argv);
  keep_memory();
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  std::signal(SIGPIPE, SIG_IGN);

  CLI::App app("Trains a policy for a production line.");
  app.name("linewright train");
  trainer::TrainArguments arguments;
  trainer::add_options(app, arguments);
  try {
    app.parse(argc, argv);
    return trainer::run(arguments);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const ScenarioError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return trainer::interrupted().requested() ? 130 : 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "internal error: {}\nThis is a defect of linewright; please report it.\n",
               error.what());
    return 3;
  }
}
