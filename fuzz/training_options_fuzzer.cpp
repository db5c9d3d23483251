// Any text is either options, which then read back what they write, or a ScenarioError. What stands
// behind the first zero byte is an override.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "linewright/base/diagnostic.hpp"
#include "linewright/training/training_options.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace linewright;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const std::size_t zero = text.find('\0');
  std::vector<std::string> overrides;
  if (zero != std::string_view::npos) overrides.emplace_back(text.substr(zero + 1));
  TrainingOptions options;
  try {
    options = training_options_from_text(text.substr(0, zero), "fuzz.yaml", overrides);
  } catch (const ScenarioError&) {
    return 0;
  }
  const std::string yaml = to_yaml(options);
  if (to_yaml(training_options_from_text(yaml, "again.yaml")) != yaml) std::abort();
  return 0;
}
