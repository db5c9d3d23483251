#include "drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "linewright/base/markup.hpp"
#include "linewright/charts/chart.hpp"

namespace linewright::charts {
namespace {

using markup::coordinate;
using markup::escaped;

/// A marker around the origin, in the order of the styles.
struct Shape {
  const char* path;
  bool open;  ///< an outline, filled with the colour of the ground
};

constexpr const char* kCircle = "M-4.5 0a4.5 4.5 0 1 0 9 0a4.5 4.5 0 1 0-9 0z";
constexpr const char* kSquare = "M-4-4h8v8h-8z";
constexpr const char* kUp = "M0-5.2l5 8.7h-10z";
constexpr const char* kDown = "M0 5.2l5-8.7h-10z";
constexpr const char* kDiamond = "M0-5.8l5 5.8-5 5.8-5-5.8z";
// Outlines are smaller by half their stroke.
constexpr const char* kOpenCircle = "M-3.8 0a3.8 3.8 0 1 0 7.6 0a3.8 3.8 0 1 0-7.6 0z";
constexpr const char* kOpenSquare = "M-3.4-3.4h6.8v6.8h-6.8z";
constexpr const char* kOpenUp = "M0-4.7l4.2 7.3h-8.4z";
constexpr const char* kOpenDown = "M0 4.7l4.2-7.3h-8.4z";
constexpr const char* kOpenDiamond = "M0-4.9l4.2 4.9-4.2 4.9-4.2-4.9z";
constexpr const char* kCross =
    "M-2.8-4.6l2.8 2.8 2.8-2.8 1.8 1.8-2.8 2.8 2.8 2.8-1.8 1.8-2.8-2.8-2.8 "
    "2.8-1.8-1.8 2.8-2.8-2.8-2.8z";
constexpr const char* kPlus = "M-1.4-5h2.8v3.6h3.6v2.8h-3.6v3.6h-2.8v-3.6h-3.6v-2.8h3.6z";
constexpr std::array<Shape, kChartStyles> kShapes = {{{kCircle, false},
                                                      {kSquare, false},
                                                      {kUp, false},
                                                      {kDiamond, false},
                                                      {kDown, false},
                                                      {kOpenCircle, true},
                                                      {kOpenSquare, true},
                                                      {kOpenUp, true},
                                                      {kOpenDiamond, true},
                                                      {kCross, false},
                                                      {kPlus, false},
                                                      {kOpenDown, true}}};

/// A family of parallel lines across bars: those with x * dx + y * dy = a multiple of `gap`.
struct Hatch {
  double dx = 0.0;
  double dy = 0.0;
  double gap = 6.0;
};

// Neighbouring styles differ; the first of all, and the lightest, are plain.
constexpr std::array<std::array<Hatch, 2>, kChartStyles> kHatches = {{
    {},                         // blue
    {{{1, 1, 7}}},              // vermilion
    {{{1, -1, 7}}},             // green
    {{{0, 1, 5}}},              // purple
    {},                         // orange
    {{{1, 1, 8}, {1, -1, 8}}},  // sky
    {},                         // ink
    {{{0, 1, 5}, {1, 0, 5}}},   // violet
    {{{1, 1, 4.5}}},            // brown
    {{{1, -1, 4.5}}},           // olive
    {{{1, 0, 4}}},              // grey
    {{{0, 1, 9}}},              // wine
}};

std::string tip_of(std::string_view tip) {
  return tip.empty() ? "" : fmt::format("<title>{}</title>", escaped(tip));
}

/// The lines of one family within the box.
std::string hatch_path(const Hatch& hatch, const Box& box) {
  if (hatch.dx == 0.0 && hatch.dy == 0.0) return "";
  std::string path;
  // Counted from the box's lower left corner, so that equal bars look alike.
  const double width = box.width();
  const double height = box.height();
  const double reach = std::abs(hatch.dx) * width + std::abs(hatch.dy) * height;
  const double offset = hatch.dy < 0.0 ? -height : 0.0;
  for (double sum = hatch.gap * 0.5; sum < reach; sum += hatch.gap) {
    const double c = sum + offset;  // dx * x + dy * y = c, with x, y from the corner
    Point from;
    Point to;
    if (hatch.dx == 0.0) {
      from = {0.0, c / hatch.dy};
      to = {width, c / hatch.dy};
    } else {
      const auto x_at = [&](double y) { return (c - hatch.dy * y) / hatch.dx; };
      const auto y_at = [&](double x) { return (c - hatch.dx * x) / hatch.dy; };
      from = {x_at(0.0), 0.0};
      to = {x_at(height), height};
      for (Point* end : {&from, &to}) {
        if (end->x < 0.0) *end = {0.0, y_at(0.0)};
        if (end->x > width) *end = {width, y_at(width)};
      }
    }
    path += "M" + pair({box.left + from.x, box.bottom - from.y}) + "L" +
            pair({box.left + to.x, box.bottom - to.y});
  }
  return path;
}

}  // namespace

bool Box::contains(Point p) const {
  return p.x >= left && p.x <= right && p.y >= top && p.y <= bottom;
}

bool Box::meets(const Box& other) const {
  return left < other.right && other.left < right && top < other.bottom && other.top < bottom;
}

std::string at(double value) {
  constexpr double kFar = 1e5;
  return coordinate(std::clamp(value, -kFar, kFar));
}

std::string pair(Point p) { return at(p.x) + " " + at(p.y); }

std::string style_class(char kind, std::size_t style) {
  return fmt::format("lw-{}{}", kind, style % kChartStyles);
}

std::string text(std::string_view look, Point p, std::string_view words) {
  return fmt::format("<text class=\"{}\" x=\"{}\" y=\"{}\">{}</text>\n", look, at(p.x), at(p.y),
                     escaped(words));
}

std::string line(std::string_view look, Point from, Point to) {
  return fmt::format("<path class=\"{}\" d=\"M{}L{}\"/>\n", look, pair(from), pair(to));
}

std::string marker(std::size_t style, Point p, std::string_view tip) {
  const Shape& shape = kShapes[style % kChartStyles];
  return fmt::format(
      "<path class=\"lw-marker {}\" transform=\"translate({})\" d=\"{}\">{}</path>\n",
      shape.open ? "lw-open " + style_class('s', style) : style_class('f', style), pair(p),
      shape.path, tip_of(tip));
}

std::string bar(std::size_t style, const Box& box, Fill fill, std::string_view tip) {
  std::string svg = fmt::format(
      "<rect class=\"lw-bar {}\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\">{}</rect>\n",
      style_class('f', style), at(box.left), at(box.top), at(box.width()), at(box.height()),
      tip_of(tip));
  if (fill == Fill::kPlain) return svg;
  std::string path;
  for (const Hatch& hatch : kHatches[style % kChartStyles]) path += hatch_path(hatch, box);
  if (!path.empty()) svg += fmt::format("<path class=\"lw-hatch\" d=\"{}\"/>\n", path);
  return svg;
}

std::string diamond(Point p, double width, std::string_view tip) {
  const double half = std::clamp(width * 0.5, 2.0, 4.5);
  return fmt::format(
      "<path class=\"lw-diamond\" transform=\"translate({0})\" "
      "d=\"M0-{1}L{1} 0L0 {1}L-{1} 0z\">{2}</path>\n",
      pair(p), at(half), tip_of(tip));
}

std::string reference_look(std::size_t n, std::optional<std::size_t> style) {
  // Dashes of the style sheet that are short enough to be told apart in the legend.
  constexpr std::array<std::size_t, 4> kDashes = {4, 2, 7, 1};
  return fmt::format("lw-ref {}{}", style_class('d', kDashes[n % kDashes.size()]),
                     style ? " " + style_class('s', *style) : "");
}

std::string clipped(const Box& box, std::string_view svg) {
  if (svg.empty()) return "";
  // A picture within the picture clips without an id, which could clash with another chart's.
  const std::string place =
      fmt::format("{} {} {}", pair({box.left, box.top}), at(box.width()), at(box.height()));
  return fmt::format(
      "<svg x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" viewBox=\"{}\">\n{}</svg>\n", at(box.left),
      at(box.top), at(box.width()), at(box.height()), place, svg);
}

}  // namespace linewright::charts
