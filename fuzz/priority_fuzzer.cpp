// The first byte chooses: `p`, the rest is a priority file of a line of three tasks; else the spec
// of a planner and a list of planners. Either it is read or a ScenarioError comes out, and an order
// that was read is read again from its own text.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "linewright/base/diagnostic.hpp"
#include "linewright/planning/lookahead.hpp"
#include "linewright/planning/planner.hpp"
#include "linewright/planning/priority_file.hpp"

namespace {

void check(bool holds) {
  if (!holds) std::abort();
}

linewright::LineModel line_of_three() {
  linewright::LineModel line;
  line.name = "three";
  for (const char* name : {"cut", "glue", "pack"}) {
    line.tasks.push_back(
        {.name = name, .number = static_cast<std::int32_t>(line.tasks.size() + 1)});
  }
  return line;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace linewright;
  if (size == 0) return 0;
  const std::string_view rest(reinterpret_cast<const char*>(data) + 1, size - 1);
  try {
    if (data[0] == 'p') {
      const LineModel line = line_of_three();
      const auto entries = parse_priority_file(rest, "fuzz.priority", line, 1);
      const std::string text = priority_text(line, 1, entries);
      const auto again = parse_priority_file(text, "again.priority", line, 1);
      check(again.size() == entries.size() && again[0].tuned.order == entries[0].tuned.order);
    } else {
      std::string joined;
      for (const std::string& planner : split_planners(rest)) {
        joined += (joined.empty() ? "" : ",") + planner;
      }
      check(joined == rest || rest.empty() || rest[0] == ',');
      const LookaheadOptions options = parse_lookahead(rest);
      check((options.budget_ns > 0) != (options.rollouts > 0));
    }
  } catch (const ScenarioError&) {
  }
  return 0;
}
