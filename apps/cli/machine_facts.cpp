#include "machine_facts.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <fstream>
#include <string_view>
#include <thread>

namespace linewright::cli {
namespace {

/// What follows `key` and a separator in the first line of the file that begins with it.
std::string value_of(const char* file, std::string_view key, char separator) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    if (!std::string_view(line).starts_with(key)) continue;
    const std::size_t at = line.find(separator);
    if (at == std::string::npos) continue;
    const std::size_t begin = line.find_first_not_of(" \t\"", at + 1);
    if (begin == std::string::npos) continue;
    return line.substr(begin, line.find_last_not_of(" \t\"") + 1 - begin);
  }
  return {};
}

}  // namespace

std::string machine_facts() {
  std::string facts = fmt::format("{} cores", std::thread::hardware_concurrency());
  const std::string processor = value_of("/proc/cpuinfo", "model name", ':');
  if (!processor.empty()) facts = fmt::format("{}, {}", processor, facts);
  const long pages = sysconf(_SC_PHYS_PAGES);
  const long page = sysconf(_SC_PAGESIZE);
  if (pages > 0 && page > 0) {
    facts += fmt::format(", {:.0f} GB of memory",
                         static_cast<double>(pages) * static_cast<double>(page) / 1e9);
  }
  const std::string system = value_of("/etc/os-release", "PRETTY_NAME", '=');
  if (!system.empty()) facts += ", " + system;
#if defined(__clang__)
  facts += fmt::format(", clang {}", __clang_version__);
#elif defined(__GNUC__)
  facts += fmt::format(", gcc {}", __VERSION__);
#endif
  return facts;
}

}  // namespace linewright::cli
