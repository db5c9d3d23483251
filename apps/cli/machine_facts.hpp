#pragma once

#include <string>

namespace linewright::cli {

/// This machine in words, as far as the system tells: processor, cores, memory, operating system.
[[nodiscard]] std::string machine_facts();

}  // namespace linewright::cli
