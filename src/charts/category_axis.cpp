#include "category_axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "head.hpp"
#include "linewright/base/markup.hpp"

namespace linewright::charts {
namespace {

constexpr double kApart = 8.0;         // least distance between names side by side
constexpr std::size_t kMostLines = 3;  // of a level name
constexpr double kLine = 16.0;
constexpr double kLongest = 150.0;    // of a slanted name
constexpr double kSlantedGap = 30.0;  // least distance between slanted names along the axis
constexpr double kSine = 0.5;         // they rise by 30 degrees
constexpr double kCosine = 0.8660254037844386;

/// The names in a few lines. Nothing when one of them does not fit.
std::vector<std::vector<std::string>> level_names(const std::vector<std::string>& names,
                                                  double room) {
  std::vector<std::vector<std::string>> result;
  for (const std::string& name : names) {
    result.push_back(wrapped(name, room, kTickSize, kMostLines));
    const bool shortened = !name.empty() && !name.ends_with(result.back().back());
    if (shortened) return {};
  }
  return result;
}

/// The height of slanted names, which are shortened to the room at their left.
double slant(const std::vector<std::string>& names, double left, double slot, CategoryAxis& axis) {
  double widest = 0.0;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const double to_edge = left + slot * (static_cast<double>(i) + 0.5) - 6.0;
    const double room = std::min(kLongest, to_edge / kCosine);
    const std::string name = markup::shortened(names[i], room, kTickSize);
    widest = std::max(widest, markup::text_width(name, kTickSize));
    axis.names.push_back({name});
  }
  return widest * kSine + kTickSize * kCosine;
}

}  // namespace

CategoryAxis make_category_axis(const std::vector<std::string>& names, double left, double width) {
  CategoryAxis axis;
  const double slot = width / static_cast<double>(std::max<std::size_t>(names.size(), 1));
  axis.names = level_names(names, slot - kApart);
  axis.slanted = axis.names.size() != names.size();
  if (axis.slanted) {
    axis.height = slant(names, left, slot, axis);
    axis.every = static_cast<std::size_t>(std::max(1.0, std::ceil(kSlantedGap / slot)));
    return axis;
  }
  std::size_t most = 1;
  for (const auto& lines : axis.names) most = std::max(most, lines.size());
  axis.height = kTickSize + static_cast<double>(most - 1) * kLine;
  return axis;
}

std::string draw_category_axis(const CategoryAxis& axis, const Box& plot) {
  std::string svg;
  const double slot = plot.width() / static_cast<double>(axis.names.size());
  for (std::size_t i = 0; i < axis.names.size(); i += axis.every) {
    const Point top{plot.left + slot * (static_cast<double>(i) + 0.5), plot.bottom + 7.0};
    if (axis.slanted) {
      svg += fmt::format("<g transform=\"translate({}) rotate(-30)\">{}</g>\n",
                         pair({top.x + 4.0, top.y + kTickSize * 0.6}),
                         text("lw-tick-x lw-end lw-muted", {}, axis.names[i].front()));
      continue;
    }
    for (std::size_t n = 0; n < axis.names[i].size(); ++n) {
      const double y = top.y + kTickSize + static_cast<double>(n) * kLine;
      svg += text("lw-tick-x lw-mid lw-muted", {top.x, y}, axis.names[i][n]);
    }
  }
  return svg;
}

}  // namespace linewright::charts
