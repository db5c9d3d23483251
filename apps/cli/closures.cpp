#include <fmt/format.h>

#include <charconv>
#include <string_view>

#include "common.hpp"
#include "linewright/base/diagnostic.hpp"

namespace linewright::cli {
namespace {

[[noreturn]] void malformed(const std::string& text) {
  throw ScenarioError({}, fmt::format("--close: '{}' is no ZONE@TICK+TICKS", text),
                      "write --close ramp@100+50: closed from the start of tick 100 for 50 ticks");
}

Tick ticks_in(std::string_view digits, const std::string& text) {
  Tick value = 0;
  const auto parsed = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (parsed.ec != std::errc() || parsed.ptr != digits.data() + digits.size() || value < 1 ||
      value > kMaxTicks) {
    malformed(text);
  }
  return value;
}

std::int32_t zone_named(const LineModel& line, const std::string& name) {
  std::vector<std::string> names;
  for (std::size_t z = 0; z < line.zones.size(); ++z) {
    if (line.zones[z].name == name) return static_cast<std::int32_t>(z);
    names.push_back(line.zones[z].name);
  }
  throw ScenarioError({}, fmt::format("--close: line '{}' has no zone '{}'", line.name, name),
                      names.empty()
                          ? "it has no zones; docs/formats/scenario.md says how to write them"
                          : name_hint(name, names));
}

}  // namespace

void add_close_option(CLI::App& app, RunArguments& arguments) {
  app.add_option("--close", arguments.close,
                 "Close a zone from the start of a tick for so many ticks (repeatable)")
      ->type_name("ZONE@TICK+TICKS")
      ->delimiter(';');
}

std::vector<Closure> closures_of(const RunArguments& arguments, const LineModel& line) {
  std::vector<Closure> closures;
  for (const std::string& text : arguments.close) {
    const std::size_t at = text.rfind('@');
    const std::size_t plus = text.rfind('+');
    if (at == std::string::npos || plus == std::string::npos || plus < at) malformed(text);
    const std::string_view view = text;
    const Tick first = ticks_in(view.substr(at + 1, plus - at - 1), text);
    const Tick ticks = ticks_in(view.substr(plus + 1), text);
    closures.push_back({zone_named(line, text.substr(0, at)), first, first + ticks});
  }
  return closures;
}

}  // namespace linewright::cli
