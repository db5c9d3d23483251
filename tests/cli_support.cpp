#include "tests/cli_support.hpp"

#ifdef LINEWRIGHT_CLI

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace linewright::testing {

std::string read_file(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

std::string temporary(const std::string& name) {
  return fmt::format("{}/linewright_cli_{}_{}", ::testing::TempDir(), getpid(), name);
}

Output linewright(const std::string& arguments) { return linewright_in(".", arguments); }

Output linewright_in(const std::string& folder, const std::string& arguments,
                     const std::string& program) {
  const std::string errors = temporary("errors.txt");
  const std::string command =
      fmt::format("cd {} && {} {} 2>{}", folder, program, arguments, errors);
  Output output;
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return output;
  std::array<char, 4096> buffer{};
  while (const std::size_t n = fread(buffer.data(), 1, buffer.size(), pipe))
    output.out.append(buffer.data(), n);
  const int status = pclose(pipe);
  output.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  output.err = read_file(errors);
  std::filesystem::remove(errors);
  return output;
}

bool has_trainer() {
  return std::filesystem::exists(std::filesystem::path(LINEWRIGHT_CLI).parent_path() /
                                 "linewright-train");
}

}  // namespace linewright::testing

#endif
