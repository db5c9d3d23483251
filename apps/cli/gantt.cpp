#include "linewright/evaluation/gantt.hpp"

#include <memory>
#include <nlohmann/json.hpp>

#include "common.hpp"
#include "linewright/evaluation/log_document.hpp"

namespace linewright::cli {

Command add_gantt(CLI::App& app) {
  struct Arguments {
    std::string log;
    std::string out;
    bool json = false;
  };
  auto arguments = std::make_shared<Arguments>();
  app.add_option("log", arguments->log, "Event log (docs/formats/event_log.md)")
      ->required()
      ->type_name("LOG.jsonl");
  app.add_option("-o,--out", arguments->out,
                 "Where to write the chart; .svg or .html (default: beside the log)")
      ->type_name("FILE.html|FILE.svg");
  app.add_flag("--json", arguments->json, "Print one JSON object (docs/cli.md) instead of text");
  app.footer("Example:\n  linewright gantt out/run.jsonl --out out/run.svg");
  return [arguments] {
    const GanttChart chart = make_gantt(load_event_log(arguments->log));
    std::string out = arguments->out;
    if (out.empty()) {
      const std::size_t dot = arguments->log.rfind('.');
      const std::size_t slash = arguments->log.rfind('/');
      const bool extension =
          dot != std::string::npos && (slash == std::string::npos || dot > slash);
      out = arguments->log.substr(0, extension ? dot : std::string::npos) + ".html";
    }
    write_gantt(chart, out);
    print(arguments->json ? nlohmann::ordered_json{{"gantt", out}}.dump(2) + "\n"
                          : "Gantt chart  " + out + "\n");
    return static_cast<int>(kOk);
  };
}

}  // namespace linewright::cli
