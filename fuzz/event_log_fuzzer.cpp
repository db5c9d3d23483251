// Any text is either an event log, or the beginning of one, whose chart and hall can be drawn, or a
// ScenarioError.

#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>

#include "linewright/base/diagnostic.hpp"
#include "linewright/evaluation/gantt.hpp"
#include "linewright/evaluation/hall_picture.hpp"
#include "linewright/evaluation/log_document.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::istringstream stream(std::string(reinterpret_cast<const char*>(data), size));
  try {
    const linewright::LogDocument log =
        linewright::read_event_log(stream, "fuzz.jsonl", linewright::CutOffLog::kAccept);
    const auto chart = linewright::make_gantt(log);
    static_cast<void>(linewright::gantt_svg(chart));
    static_cast<void>(linewright::gantt_html(chart));
    static_cast<void>(linewright::hall_picture(log, log.end.tick / 2));
  } catch (const linewright::ScenarioError&) {
  }
  return 0;
}
