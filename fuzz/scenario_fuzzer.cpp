// Any text is either a scenario or a ScenarioError: nothing else may come out of the loader.

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "linewright/base/diagnostic.hpp"
#include "linewright/scenario/load.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    static_cast<void>(linewright::load_scenario_text(text, "fuzz.yaml"));
  } catch (const linewright::ScenarioError&) {
  }
  return 0;
}
