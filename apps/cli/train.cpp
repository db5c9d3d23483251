#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "common.hpp"
#include "linewright/base/diagnostic.hpp"
#include "train_jobs.hpp"

namespace linewright::cli {

Command add_train(CLI::App& app) {
  // Never parsed here: start_trainer() takes everything behind the word `train`.
  app.footer("linewright train --help shows the options.");
  return [] { return kOk; };
}

void start_trainer(char** arguments) {
  const std::string program = trainer_program();
  static char name[] = "linewright-train";  // what the list of processes shows
  arguments[0] = name;
  execv(program.c_str(), arguments);
  throw ScenarioError(program, fmt::format("cannot be started: {}", std::strerror(errno)), "");
}

}  // namespace linewright::cli
