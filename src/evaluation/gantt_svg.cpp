#include <fmt/format.h>

#include "gantt_body.hpp"
#include "gantt_style.hpp"
#include "linewright/base/markup.hpp"
#include "linewright/evaluation/gantt.hpp"

namespace linewright {
namespace {

using markup::coordinate;
using markup::escaped;

constexpr double kMargin = 20.0;
constexpr double kLegendLine = 22.0;

/// Lays samples with words side by side, line by line.
class Legend {
 public:
  Legend(double width, double top) : width_(width), y_(top) {}

  void add(const char* texture, const std::string& style, const std::string& number,
           const std::string& words) {
    const std::string shown = markup::shortened(words, 300.0, 12.0);
    const double needed = 28.0 + markup::text_width(shown, 12.0) + 14.0;
    if (x_ > 0.0 && x_ + needed > width_) next_line();
    const bool thin = texture[0] == 'h' && number.empty();
    svg_ += fmt::format(
        "<rect class=\"bar {}{}\" x=\"{}\" y=\"{}\" width=\"22\" height=\"{}\" rx=\"1.5\"/>\n",
        texture, style, coordinate(x_), coordinate(y_ + (thin ? 3.5 : 0.0)), thin ? 9 : 16);
    if (!number.empty()) {
      svg_ += fmt::format("<text class=\"name l{}\" x=\"{}\" y=\"{}\">{}</text>\n", style,
                          coordinate(x_ + 11.0), coordinate(y_ + 11.7), escaped(number));
    }
    svg_ += fmt::format("<text class=\"ink\" x=\"{}\" y=\"{}\">{}</text>\n", coordinate(x_ + 28.0),
                        coordinate(y_ + 12.5), escaped(shown));
    x_ += needed;
  }

  void next_line() {
    x_ = 0.0;
    y_ += kLegendLine;
  }

  void gap() { x_ += 22.0; }

  [[nodiscard]] double bottom() const { return y_ + kLegendLine; }
  [[nodiscard]] const std::string& svg() const { return svg_; }

 private:
  double width_;
  double x_ = 0.0;
  double y_;
  std::string svg_;
};

std::string facts_line(const GanttChart& chart) {
  std::string line;
  for (const std::string& fact : chart.facts) line += (line.empty() ? "" : "  ·  ") + fact;
  return line;
}

Legend legend_of(const GanttChart& chart, double width, double top) {
  Legend legend(width, top);
  for (std::size_t task = 0; task < chart.tasks.size(); ++task) {
    legend.add("s", std::to_string(gantt::style_of(task)), std::to_string(chart.tasks[task].number),
               chart.tasks[task].name);
  }
  if (!chart.tasks.empty()) legend.next_line();
  legend.add("s", "n", "", "work, or a machine in an operation");
  legend.add("h", "n", "", "travel, or a machine recovering");
  legend.add("o", "n", "", "waiting, or a machine held between operations");
  return legend;
}

}  // namespace

std::string gantt_svg(const GanttChart& chart) {
  const gantt::Body body = gantt::draw_body(chart, {});
  const Legend legend = legend_of(chart, body.width, 62.0);
  const double top = legend.bottom() + 8.0;
  const double width = body.width + 2.0 * kMargin;
  const double height = top + body.height + 2.0 * kMargin;
  const std::string name = escaped(chart.title);
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} "
      "{1}\" "
      "role=\"img\">\n<title>{2}</title>\n<desc>{3}</desc>\n<style>{4}</style>\n{5}",
      coordinate(width), coordinate(height), name, escaped(facts_line(chart)),
      gantt::style_sheet(chart.tasks.size()), gantt::hatchings(chart.tasks.size()));
  svg += fmt::format(
      "<rect class=\"bg\" width=\"100%\" height=\"100%\"/>\n<g transform=\"translate({0} {0})\">\n",
      coordinate(kMargin));
  svg += fmt::format("<text class=\"title ink\" x=\"0\" y=\"18\">{}</text>\n", name);
  svg +=
      fmt::format("<text class=\"muted\" x=\"0\" y=\"42\">{}</text>\n", escaped(facts_line(chart)));
  svg += legend.svg();
  svg += fmt::format("<svg y=\"{}\" width=\"{}\" height=\"{}\">\n{}</svg>\n</g>\n</svg>\n",
                     coordinate(top), coordinate(body.width), coordinate(body.height), body.svg);
  return svg;
}

}  // namespace linewright
