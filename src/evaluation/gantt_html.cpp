#include <fmt/format.h>

#include "gantt_body.hpp"
#include "gantt_page.hpp"
#include "gantt_style.hpp"
#include "linewright/base/markup.hpp"
#include "linewright/evaluation/gantt.hpp"

namespace linewright {
namespace {

using markup::coordinate;
using markup::escaped;

std::string swatch(char texture, const std::string& style, const std::string& number) {
  const bool thin = texture == 'h';
  return fmt::format(
      "<svg width=\"24\" height=\"18\" aria-hidden=\"true\"><rect class=\"bar {}{}\" x=\"1\" "
      "y=\"{}\" "
      "width=\"22\" height=\"{}\" rx=\"1.5\"/><text class=\"name l{}\" x=\"12\" "
      "y=\"12.7\">{}</text></svg>",
      texture, style, thin ? "4.5" : "1", thin ? 9 : 16, style, number);
}

std::string legend(const GanttChart& chart) {
  std::string html =
      "<div class=\"legend\" role=\"group\" aria-label=\"Tasks: press one to highlight it\">\n";
  for (std::size_t task = 0; task < chart.tasks.size(); ++task) {
    html += fmt::format(
        "<button type=\"button\" data-task=\"{}\" aria-pressed=\"false\">{}{}</button>\n", task,
        swatch('s', std::to_string(gantt::style_of(task)),
               std::to_string(chart.tasks[task].number)),
        escaped(chart.tasks[task].name));
  }
  return html + "</div>\n";
}

std::string tools() {
  std::string html =
      "<div class=\"bar-of-tools\"><span class=\"tools\">"
      "<button type=\"button\" id=\"out\" aria-label=\"Zoom out\">−</button> "
      "<button type=\"button\" id=\"in\" aria-label=\"Zoom in\">+</button> "
      "<button type=\"button\" id=\"all\">whole run</button></span>";
  const auto sample = [&](char texture, const char* words) {
    html += fmt::format("<span class=\"sample\">{}{}</span>", swatch(texture, "n", ""), words);
  };
  sample('s', "work, or a machine in an operation");
  sample('h', "travel, or a machine recovering");
  sample('o', "waiting, or a machine held between operations");
  return html + "</div>\n";
}

constexpr const char* kHint =
    "<p class=\"hint\">Wheel: zoom. Drag: move; along the axis: zoom to what is marked. Double "
    "click: whole run. "
    "In the chart, by keyboard: <kbd>←</kbd> <kbd>→</kbd> <kbd>↑</kbd> <kbd>↓</kbd> from bar to "
    "bar, "
    "<kbd>+</kbd> <kbd>−</kbd> <kbd>0</kbd> zoom, <kbd>Shift</kbd> with <kbd>←</kbd> <kbd>→</kbd> "
    "moves, "
    "<kbd>Esc</kbd> lets go.</p>\n";

std::string head(const GanttChart& chart) {
  // The policy is a second wall behind the escaping: only the script below runs, and nothing is
  // loaded.
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
      "style-src 'unsafe-inline'; script-src 'nonce-linewright'\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>{} – Gantt chart</title>\n<style>{}{}</style>\n</head>\n",
      escaped(chart.title), gantt::style_sheet(chart.tasks.size()), gantt::kPageStyle);
}

std::string facts(const GanttChart& chart) {
  std::string html = "<p class=\"facts\">";
  for (std::size_t i = 0; i < chart.facts.size(); ++i) {
    html += (i == 0 ? "" : " &nbsp;·&nbsp; ") + escaped(chart.facts[i]);
  }
  return html + "</p>\n";
}

std::string drawing(const GanttChart& chart) {
  const gantt::Body body = gantt::draw_body(chart, {.all_labels = true});
  return fmt::format(
      "<div id=\"frame\"><svg id=\"chart\" width=\"{}\" height=\"{}\" tabindex=\"0\" "
      "role=\"application\" "
      "aria-label=\"Gantt chart\" data-last=\"{}\" data-tick=\"{}\" data-gutter=\"{}\" "
      "data-right=\"{}\">\n"
      "{}{}</svg></div>\n",
      coordinate(body.width), coordinate(body.height), chart.last, chart.tick_s,
      coordinate(body.gutter), coordinate(body.right), gantt::hatchings(chart.tasks.size()),
      body.svg);
}

}  // namespace

std::string gantt_html(const GanttChart& chart) {
  std::string html = head(chart);
  html += fmt::format("<body>\n<h1>{}</h1>\n", escaped(chart.title));
  html += facts(chart) + legend(chart) + tools() + drawing(chart) + kHint;
  html +=
      "<div id=\"tip\" hidden></div>\n<div id=\"said\" class=\"unseen\" "
      "aria-live=\"polite\"></div>\n";
  html += fmt::format("<script nonce=\"linewright\">{}</script>\n</body>\n</html>\n",
                      gantt::kPageScript);
  return html;
}

}  // namespace linewright
