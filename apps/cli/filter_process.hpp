#pragma once

#include <functional>
#include <string>
#include <vector>

namespace linewright::cli {

struct FilterResult {
  bool success = false;    ///< it was started and ended with exit code 0
  std::string last_error;  ///< last line of its standard error, or why it was not started
};

/// Runs a program (found on the PATH): `input` is its standard input, and each line of its standard
/// output is passed to `on_line` as it comes. Ctrl-C is passed on to it once.
FilterResult run_filter(const std::vector<std::string>& words, const std::string& input,
                        const std::function<void(const std::string&)>& on_line);

}  // namespace linewright::cli
