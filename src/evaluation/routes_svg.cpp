#include "linewright/evaluation/routes_svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "linewright/base/markup.hpp"
#include "routes_hall.hpp"
#include "routes_panel.hpp"
#include "routes_style.hpp"

namespace linewright {
namespace {

using markup::coordinate;
using markup::escaped;
using routes::View;

constexpr double kMargin = 20.0;
constexpr double kGap = 16.0;
constexpr double kHeadHeight = 52.0;
constexpr double kLegendHeight = 34.0;
constexpr double kNarrowest = 740.0;  // the legend's width

/// The kinds of the panels, each once: "human: hybrid_a_star, 90 pairs".
std::string facts_line(const Scenario& scenario, const std::vector<RoutesPanel>& panels) {
  const Rectangle& hall = scenario.map->bounds;
  std::string line =
      fmt::format("hall {:.6g} m x {:.6g} m", hall.x1_m - hall.x0_m, hall.y1_m - hall.y0_m);
  for (std::size_t kind = 0; kind < scenario.routes.size(); ++kind) {
    if (std::none_of(panels.begin(), panels.end(),
                     [&](const RoutesPanel& panel) { return panel.kind == kind; })) {
      continue;
    }
    const KindRoutes& routes = *scenario.routes[kind];
    line += fmt::format("  ·  {}: {} routes by {}", routes.request.kind,
                        routes.routes.pairs() - routes.routes.failed(), routes.request.planner);
    if (routes.routes.failed() > 0) line += fmt::format(", {} missing", routes.routes.failed());
  }
  return line;
}

std::string legend_svg(const View& view, double right) {
  std::string svg;
  double x = 8.0;
  const auto entry = [&](const std::string& sample, const std::string& words) {
    svg += fmt::format("<g transform=\"translate({} 11)\">{}</g>\n", coordinate(x), sample);
    svg += fmt::format("<text class=\"ink\" x=\"{}\" y=\"15\">{}</text>\n", coordinate(x + 34.0),
                       words);
    x += 34.0 + markup::text_width(words, 12.0) + 18.0;
  };
  entry(
      "<path class=\"tick\" d=\"M12 0h11.5\"/><circle class=\"start\" cx=\"12\" r=\"8\"/>"
      "<circle class=\"stop mark\" cx=\"12\" r=\"5\"/>",
      "start");
  entry("<path class=\"tick\" d=\"M12 0h9\"/><circle class=\"stop s4\" cx=\"12\" r=\"3.6\"/>",
        "station, heading");
  entry("<path class=\"way k4\" stroke-width=\"2.4\" d=\"M0 0h26\"/>", "route, coloured by goal");
  entry("<path class=\"way back k4\" stroke-width=\"2.4\" d=\"M0 0h26\"/>", "backwards");
  entry("<rect class=\"block\" x=\"2\" y=\"-6\" width=\"22\" height=\"12\"/>", "obstacle");
  return svg + routes::scale_bar(view, right);
}

/// Everything between the head and the foot.
std::string panels_svg(const Scenario& scenario, const std::vector<RoutesPanel>& panels,
                       const View& view, std::size_t columns) {
  std::string svg;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const double x = static_cast<double>(i % columns) * (view.width + kGap);
    const double y = static_cast<double>(i / columns) * (view.height + routes::kTitleHeight + kGap);
    svg += fmt::format("<g class=\"panel-of\" transform=\"translate({} {})\">\n{}</g>\n",
                       coordinate(x), coordinate(kHeadHeight + y),
                       routes::panel_svg(scenario, panels[i], view));
  }
  return svg;
}

}  // namespace

std::string routes_svg(const Scenario& scenario, const std::vector<RoutesPanel>& panels) {
  const View view = routes::view_of(scenario.map->bounds);
  const std::size_t columns = std::min<std::size_t>(2, panels.size());
  const auto rows = static_cast<double>((panels.size() + columns - 1) / columns);
  const double inner =
      std::max(kNarrowest, static_cast<double>(columns) * (view.width + kGap) - kGap);
  const double bottom = kHeadHeight + rows * (view.height + routes::kTitleHeight + kGap);
  const double width = inner + 2.0 * kMargin;
  const double height = bottom + kLegendHeight + 2.0 * kMargin;
  const std::string title = escaped(scenario.line.name + ": routes between stations");
  const std::string facts = escaped(facts_line(scenario, panels));
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} "
      "{1}\" role=\"img\">\n<title>{2}</title>\n<desc>{3}</desc>\n<style>{4}</style>\n"
      "<defs><g id=\"lw-hall\">\n{5}</g></defs>\n"
      "<rect class=\"bg\" width=\"100%\" height=\"100%\"/>\n<g transform=\"translate({6} {6})\">\n",
      coordinate(width), coordinate(height), title, facts, routes::style_sheet(),
      routes::hall_svg(*scenario.map, view), coordinate(kMargin));
  svg += fmt::format("<text class=\"title ink\" x=\"8\" y=\"18\">{}</text>\n", title);
  svg += fmt::format("<text class=\"muted\" x=\"8\" y=\"39\">{}</text>\n", facts);
  svg += panels_svg(scenario, panels, view, columns);
  svg += fmt::format("<g transform=\"translate(0 {})\">\n{}</g>\n</g>\n</svg>\n",
                     coordinate(bottom), legend_svg(view, inner - 8.0));
  return svg;
}

}  // namespace linewright
