#include "routes_panel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include "label_places.hpp"
#include "linewright/base/markup.hpp"
#include "routes_names.hpp"

namespace linewright::routes {
namespace {

using markup::coordinate;
using markup::escaped;

constexpr double kNameSize = 11.0;
constexpr double kLineHeight = 12.0;
constexpr double kWidestName = 150.0;
constexpr double kDot = 3.6;
constexpr double kStartDot = 5.0;
constexpr double kTick = 9.0;
// Where many routes share an aisle, the longer ones show beside the shorter ones on top of them.
constexpr double kThickest = 3.8;
constexpr double kThinnest = 1.5;

class PanelPainter {
 public:
  PanelPainter(const Scenario& scenario, const RoutesPanel& panel, const View& view)
      : map_(*scenario.map),
        kind_(*scenario.routes[panel.kind]),
        start_(panel.start),
        view_(view),
        placer_(view.width, view.height) {}

  std::string paint() {
    paint_title();
    svg_ += fmt::format("<g transform=\"translate(0 {})\">\n<use href=\"#lw-hall\"/>\n",
                        coordinate(kTitleHeight));
    paint_routes();
    note_obstacles();
    paint_stations();
    paint_names();
    paint_obstacle_names();
    return svg_ + "</g>\n";
  }

 private:
  [[nodiscard]] const std::vector<RouteStop>& stops() const { return kind_.request.stops; }
  [[nodiscard]] const Path& path_to(std::size_t goal) const {
    return kind_.routes.path(start_, goal);
  }

  void paint_title() {
    std::size_t found = 0;
    double metres = 0.0;
    for (std::size_t goal = 0; goal < stops().size(); ++goal) {
      if (goal == start_ || !path_to(goal).found()) continue;
      ++found;
      metres += path_to(goal).metres();
    }
    const std::size_t missing = stops().size() - 1 - found;
    const std::string who =
        fmt::format("{} from {}", markup::shortened(kind_.request.kind, 140, 14),
                    markup::shortened(stops()[start_].name, 220, 14));
    std::string facts = fmt::format("{} route{}", found, found == 1 ? "" : "s");
    if (found > 0) facts += fmt::format(", mean {:.1f} m", metres / static_cast<double>(found));
    if (missing > 0) facts += fmt::format(", {} missing", missing);
    svg_ += fmt::format(
        "<text class=\"panel ink\" x=\"8\" y=\"16\">{}<tspan class=\"muted facts\">: "
        "{}</tspan></text>\n",
        escaped(who), facts);
  }

  /// Found routes, the longest first.
  [[nodiscard]] std::vector<std::size_t> goals() const {
    std::vector<std::size_t> goals;
    for (std::size_t goal = 0; goal < stops().size(); ++goal) {
      if (goal != start_ && path_to(goal).found()) goals.push_back(goal);
    }
    std::stable_sort(goals.begin(), goals.end(), [&](std::size_t a, std::size_t b) {
      return path_to(a).metres() > path_to(b).metres();
    });
    return goals;
  }

  void paint_routes() {
    const std::vector<std::size_t> order = goals();
    for (std::size_t i = 0; i < order.size(); ++i) {
      const double share =
          order.size() < 2 ? 1.0 : static_cast<double>(i) / static_cast<double>(order.size() - 1);
      paint_route(order[i], kThickest + (kThinnest - kThickest) * share);
    }
  }

  void paint_route(std::size_t goal, double width) {
    const Path& path = path_to(goal);
    const DrawnPath lines = drawn(path, view_);
    const std::string style = std::to_string(style_of_goal(goal));
    svg_ += fmt::format("<g class=\"route\"><title>{} to {}: {:.2f} m</title>\n",
                        escaped(stops()[start_].name), escaped(stops()[goal].name), path.metres());
    const auto line = [&](const char* kind, const std::string& data) {
      if (data.empty()) return;
      svg_ += fmt::format("<path class=\"{} k{}\" stroke-width=\"{}\" d=\"{}\"/>\n", kind, style,
                          coordinate(width), data);
    };
    line("way", lines.forwards);
    line("way back", lines.backwards);
    std::vector<Pixel> line_of;
    const double step_m = 1.0 / view_.scale;
    for (const Pose2& pose : sampled(path, step_m, 7.0)) {
      line_of.push_back(view_.at(pose.point()));
      placer_.discourage(line_of.back().x, line_of.back().y, 1.0);
    }
    paint_arrow(line_of, stops()[goal].pose.heading_rad, style);
    svg_ += "</g>\n";
  }

  /// The place so much of the line before its end, or its beginning.
  static Pixel before_end(const std::vector<Pixel>& line, double pixels) {
    for (std::size_t i = line.size() - 1; i > 0; --i) {
      const double step = std::hypot(line[i].x - line[i - 1].x, line[i].y - line[i - 1].y);
      if (step >= pixels && step > 0.0) {
        const double share = pixels / step;
        return {line[i].x + (line[i - 1].x - line[i].x) * share,
                line[i].y + (line[i - 1].y - line[i].y) * share};
      }
      pixels -= step;
    }
    return line.front();
  }

  /// A head on the line, ending at the goal's dot or, when the line comes from where the heading's
  /// tick is, at the tick.
  void paint_arrow(const std::vector<Pixel>& line, double heading_rad, const std::string& style) {
    constexpr double kLength = 7.5;
    constexpr double kHalf = 3.3;
    const Pixel end = line.back();
    const Pixel near = before_end(line, kTick);
    const double ahead =
        (near.x - end.x) * std::cos(heading_rad) - (near.y - end.y) * std::sin(heading_rad);
    const double gap = ahead > 0.7 * kTick ? kTick + 1.5 : kDot;
    const Pixel tip = before_end(line, gap);
    const Pixel base = before_end(line, gap + kLength);
    const double length = std::hypot(tip.x - base.x, tip.y - base.y);
    if (length < 0.9 * kLength) return;  // too short, or the direction changes just there
    const double dx = (tip.x - base.x) / length;
    const double dy = (tip.y - base.y) / length;
    const Pixel foot{tip.x - dx * kLength, tip.y - dy * kLength};
    svg_ += fmt::format("<path class=\"s{}\" d=\"M{} {}L{} {}L{} {}Z\"/>\n", style,
                        coordinate(tip.x), coordinate(tip.y), coordinate(foot.x - dy * kHalf),
                        coordinate(foot.y + dx * kHalf), coordinate(foot.x + dy * kHalf),
                        coordinate(foot.y - dx * kHalf));
  }

  /// Names are better read on the free floor.
  void note_obstacles() {
    constexpr double kStep = 3.0;
    const OccupancyGrid& grid = *map_.grid;
    for (double y = kStep / 2.0; y < view_.height; y += kStep) {
      for (double x = kStep / 2.0; x < view_.width; x += kStep) {
        const Point2 point = view_.point({x, y});
        if (grid.blocked(grid.frame().cell_at(point))) placer_.discourage(x, y, 0.2);
      }
    }
  }

  void paint_stations() {
    for (std::size_t i = 0; i < stops().size(); ++i) paint_station(i);
  }

  void paint_station(std::size_t stop) {
    const Pose2& pose = stops()[stop].pose;
    const Pixel at = view_.at(pose.point());
    const bool start = stop == start_;
    const double tick = start ? kTick + 2.5 : kTick;
    svg_ += fmt::format("<path class=\"tick\" d=\"M{} {}L{} {}\"/>\n", coordinate(at.x),
                        coordinate(at.y), coordinate(at.x + tick * std::cos(pose.heading_rad)),
                        coordinate(at.y - tick * std::sin(pose.heading_rad)));
    const auto circle = [&](const std::string& style, double radius) {
      svg_ += fmt::format("<circle class=\"{}\" cx=\"{}\" cy=\"{}\" r=\"{}\"/>\n", style,
                          coordinate(at.x), coordinate(at.y), coordinate(radius));
    };
    if (start) {
      circle("start", kStartDot + 3.0);
      circle("stop mark", kStartDot);
    } else if (path_to(stop).found()) {
      circle(fmt::format("stop s{}", style_of_goal(stop)), kDot);
    } else {
      circle("stop missing", kDot);
      svg_ += fmt::format("<path class=\"cross\" d=\"M{0} {2}L{1} {3}M{0} {3}L{1} {2}\"/>\n",
                          coordinate(at.x - 6.0), coordinate(at.x + 6.0), coordinate(at.y - 6.0),
                          coordinate(at.y + 6.0));
    }
  }

  void paint_names() {
    std::vector<labels::Anchor> anchors;
    std::vector<std::string> names;
    for (const RouteStop& stop : stops()) {
      const Pixel at = view_.at(stop.pose.point());
      names.push_back(markup::shortened(stop.name, kWidestName, kNameSize));
      const bool start = anchors.size() == start_;
      const double dot = start ? kStartDot + 4.0 : kDot + 1.0;
      const double width = markup::text_width(names.back(), kNameSize) * (start ? 1.1 : 1.0);
      anchors.push_back({at.x, at.y, dot, width, kLineHeight});
      const double tick = start ? kTick + 4.0 : kTick;
      const double tick_x = at.x + tick * std::cos(stop.pose.heading_rad);
      const double tick_y = at.y - tick * std::sin(stop.pose.heading_rad);
      placer_.block({tick_x - 3.0, tick_y - 3.0, tick_x + 3.0, tick_y + 3.0});
    }
    const std::vector<labels::Place> places = placer_.place(anchors);
    std::string lines;
    std::string texts;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const labels::Place& place = places[i];
      if (place.led) {
        lines += fmt::format("<path class=\"lead\" d=\"M{} {}L{} {}\"/>\n", coordinate(place.x),
                             coordinate(place.y), coordinate(place.to_x), coordinate(place.to_y));
      }
      texts +=
          fmt::format("<text class=\"place mid{}\" x=\"{}\" y=\"{}\">{}</text>\n",
                      i == start_ ? " strong" : "", coordinate((place.box.x0 + place.box.x1) / 2.0),
                      coordinate(place.box.y1 - 2.8), escaped(names[i]));
    }
    svg_ += lines + texts;
  }

  void paint_obstacle_names() {
    for (const Obstacle& obstacle : map_.obstacles) {
      svg_ += name_within(obstacle.polygon, obstacle.name, view_, placer_);
    }
  }

  const HallMap& map_;
  const KindRoutes& kind_;
  std::size_t start_;
  const View& view_;
  labels::Placer placer_;
  std::string svg_;
};

}  // namespace

std::size_t style_of_goal(std::size_t goal) {
  // The chart's palette, without the two that are too pale for lines first.
  constexpr std::array<std::size_t, 12> kOrder = {4, 5, 2, 3, 7, 0, 10, 8, 1, 11, 6, 9};
  return kOrder[goal % kOrder.size()];
}

std::string panel_svg(const Scenario& scenario, const RoutesPanel& panel, const View& view) {
  return PanelPainter(scenario, panel, view).paint();
}

}  // namespace linewright::routes
