#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "common.hpp"
#include "linewright/base/diagnostic.hpp"

namespace linewright::cli {

Command add_train(CLI::App& app) {
  // Never parsed here: start_trainer() takes everything behind the word `train`.
  app.footer("linewright train --help shows the options.");
  return [] { return kOk; };
}

void start_trainer(char** arguments) {
  namespace fs = std::filesystem;
  std::error_code unknown;
  const fs::path program =
      fs::read_symlink("/proc/self/exe", unknown).parent_path() / "linewright-train";
  if (!fs::exists(program, unknown)) {
    throw ScenarioError(program.string(), "this build has no trainer: LibTorch was not found",
                        "install libtorch-dev (make demo does) and build again; trained policies "
                        "work without it");
  }
  static char name[] = "linewright-train";  // what the list of processes shows
  arguments[0] = name;
  execv(program.c_str(), arguments);
  throw ScenarioError(program.string(), fmt::format("cannot be started: {}", std::strerror(errno)),
                      "");
}

}  // namespace linewright::cli
