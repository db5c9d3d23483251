#pragma once

#include <string>

// The command line tool, run as a user runs it.
#ifdef LINEWRIGHT_CLI

namespace linewright::testing {

struct Output {
  int code = -1;
  std::string out;
  std::string err;
};

/// Runs it with these arguments, from the top of the repository.
Output linewright(const std::string& arguments);

/// The same from another folder, or with another file of the program.
Output linewright_in(const std::string& folder, const std::string& arguments,
                     const std::string& program = LINEWRIGHT_CLI);

std::string read_file(const std::string& file);

/// A path of this process alone: tests run side by side.
std::string temporary(const std::string& name);

/// Whether `linewright-train` stands beside it: without LibTorch there is none.
bool has_trainer();

}  // namespace linewright::testing

#endif
