#include "linewright/evaluation/hall_picture.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "gantt_style.hpp"
#include "hall_caption.hpp"
#include "hall_floor.hpp"
#include "hall_stage.hpp"
#include "hall_style.hpp"
#include "linewright/base/markup.hpp"
#include "routes_hall.hpp"
#include "routes_style.hpp"
#include "routes_view.hpp"

namespace linewright {
namespace {

using markup::coordinate;
using markup::escaped;

constexpr double kMargin = 20.0;
constexpr double kHeadHeight = 52.0;
constexpr double kLegendHeight = 30.0;
constexpr double kNarrowest = 900.0;    // for the caption
constexpr double kLargestScale = 42.0;  // pixels per metre: a small cell need not fill the page

/// The hall no larger than the options allow, and no larger than looks well.
routes::View view_for(const LogHeader& header, const HallPictureOptions& options) {
  const Rectangle floor = hall::floor_of(header);
  return routes::view_of(floor,
                         std::min(options.most_width, kLargestScale * (floor.x1_m - floor.x0_m)),
                         std::min(options.most_height, kLargestScale * (floor.y1_m - floor.y0_m)));
}

std::string facts_of(const LogDocument& log, const HallScene& scene) {
  const LogHeader& header = log.header;
  const std::int64_t finished = scene.tokens[header.finished_in.index()];
  std::string facts = fmt::format("{:.6g} s · {} of {} × {} finished · {} decision{} taken",
                                  scene.tick * header.tick_s, finished, header.quantity,
                                  header.product, scene.decisions, scene.decisions == 1 ? "" : "s");
  if (scene.tick >= log.end.tick) {
    facts += log.cut_off ? " · the log breaks off here" : " · the end of the run";
  }
  return facts;
}

std::string legend_svg() {
  std::string svg;
  double x = 0.0;
  const auto entry = [&](const std::string& sample, const std::string& words) {
    svg += fmt::format("<g transform=\"translate({} 11)\">{}</g>\n", coordinate(x), sample);
    svg += fmt::format("<text class=\"muted\" x=\"{}\" y=\"15\">{}</text>\n", coordinate(x + 28.0),
                       words);
    x += 28.0 + markup::text_width(words, 12.0) + 14.0;
  };
  const auto box = [](const char* style) {
    return fmt::format(
        "<rect class=\"machine {}\" x=\"2\" y=\"-6\" width=\"20\" height=\"12\" rx=\"2\"/>", style);
  };
  entry(box("sn"), "working");
  entry(box("on"), "waiting");
  entry(box("on kept"), "held");
  entry(box("hn"), "recovering");
  entry(box("idle"), "idle, free");
  entry("<path class=\"ahead kn\" d=\"M1 0h22\"/>", "way ahead, coloured by task");
  entry(
      "<rect class=\"full\" x=\"4\" y=\"-3\" width=\"6\" height=\"6\"/>"
      "<rect class=\"hole\" x=\"12\" y=\"-3\" width=\"6\" height=\"6\"/>",
      "item, room for one");
  return svg;
}

}  // namespace

std::string hall_picture(const LogDocument& log, const HallScene& scene,
                         const HallPictureOptions& options) {
  const routes::View view = view_for(log.header, options);
  const double inner = std::max(options.caption ? kNarrowest : 0.0, view.width);
  const hall::Caption caption =
      options.caption ? hall::caption_of(log, scene, inner) : hall::Caption{};
  const double below = kHeadHeight + view.height + 12.0;
  const double width = inner + 2.0 * kMargin;
  const double height = below + kLegendHeight + caption.height + 2.0 * kMargin;
  const std::size_t tasks = log.header.tasks.size();
  const std::string title = escaped(fmt::format("{} at tick {}", log.header.line, scene.tick));
  const std::string facts = escaped(facts_of(log, scene));
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} "
      "{1}\" role=\"img\">\n<title>{2}</title>\n<desc>{3}</desc>\n<style>{4}{5}</style>\n{6}"
      "<rect class=\"bg\" width=\"100%\" height=\"100%\"/>\n<g transform=\"translate({7} {7})\">\n",
      coordinate(width), coordinate(height), title, facts, routes::style_sheet(tasks),
      hall::style_rules(), gantt::hatchings(tasks), coordinate(kMargin));
  svg += fmt::format("<text class=\"title ink\" y=\"18\">{}</text>\n", title);
  svg += fmt::format("<text class=\"muted\" y=\"39\">{}</text>\n", facts);
  svg += fmt::format("<g transform=\"translate(0 24)\">\n{}</g>\n",
                     routes::scale_bar(view, (inner + view.width) / 2.0 - 8.0));
  svg += fmt::format("<g transform=\"translate({} {})\">\n{}</g>\n",
                     coordinate((inner - view.width) / 2.0), coordinate(kHeadHeight),
                     hall::stage_svg(log, scene, view));
  svg +=
      fmt::format("<g transform=\"translate(0 {})\">\n{}</g>\n", coordinate(below), legend_svg());
  svg += fmt::format("<g transform=\"translate(0 {})\">\n{}</g>\n</g>\n</svg>\n",
                     coordinate(below + kLegendHeight), caption.svg);
  return svg;
}

std::string hall_picture(const LogDocument& log, Tick tick, const HallPictureOptions& options) {
  return hall_picture(log, hall_scene(log, tick), options);
}

}  // namespace linewright
