#include <fmt/format.h>

#include <filesystem>

#include "linewright/base/diagnostic.hpp"
#include "linewright/base/files.hpp"
#include "linewright/evaluation/event_log_writer.hpp"
#include "linewright/evaluation/gantt.hpp"

namespace linewright {

void write_gantt(const GanttChart& chart, const std::string& path) {
  const std::string extension = std::filesystem::path(path).extension().string();
  if (extension == ".svg") {
    write_file(path, gantt_svg(chart));
  } else if (extension == ".html") {
    write_file(path, gantt_html(chart));
  } else {
    throw ScenarioError(path,
                        extension.empty()
                            ? std::string("has no extension that says which format to write")
                            : fmt::format("charts cannot be written as '{}'", extension),
                        "name a file that ends in .svg or .html");
  }
}

}  // namespace linewright
