#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "linewright/base/cancel.hpp"

namespace linewright::trainer {

/// What `linewright train` is asked to do.
struct TrainArguments {
  std::string algorithm = "ebq-n";  ///< a name of the folder algorithms/ or a file
  std::string preset;               ///< likewise
  std::string scenario;
  std::vector<std::string> settings;  ///< "group.key=value"
  std::vector<std::uint64_t> seeds{1};
  std::string out = "out/train";
  bool resume = false;
  bool quiet = false;
};

void add_options(CLI::App& app, TrainArguments& arguments);

/// Trains one policy per seed, one after the other. Returns the exit code.
int run(const TrainArguments& arguments);

/// Set by Ctrl-C (SIGINT) and SIGTERM.
CancelToken& interrupted();

}  // namespace linewright::trainer
