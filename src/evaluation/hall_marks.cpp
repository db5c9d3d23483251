#include "hall_marks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "gantt_style.hpp"
#include "linewright/base/markup.hpp"

namespace linewright::hall {
namespace {

using markup::coordinate;

constexpr double kSmallestDisc = 12.0;    // pixels
constexpr double kSmallestShape = 20.0;   // pixels
constexpr double kLargestShape = 2000.0;  // pixels: larger than the hall
constexpr double kTokenStep = kTokenSize + 1.5;
constexpr double kNumberSize = 10.0;
constexpr std::int64_t kMostSquares = 6;

std::string task_style(const GanttInterval& doing) {
  return doing.task ? std::to_string(gantt::style_of(*doing.task)) : "n";
}

/// A log of an earlier version does not say how large its workers are.
LogKind kind_named(const LogHeader& header, const std::string& name) {
  for (const LogKind& kind : header.kinds) {
    if (kind.name == name) return kind;
  }
  LogKind usual{.name = name, .radius_m = 0.3, .footprint_m = {}, .outline_m = {}, .speed_mps = {}};
  if (name != "human") usual.footprint_m = {1.2, 0.8};
  return usual;
}

}  // namespace

std::string style_of(const std::optional<GanttInterval>& doing, const std::string& otherwise) {
  if (!doing) return otherwise;
  switch (doing->kind) {
    case GanttKind::kWork:
    case GanttKind::kWorking:
      return "s" + task_style(*doing);
    case GanttKind::kTravel:
      return doing->task ? "s" + task_style(*doing) : otherwise;  // to rest
    case GanttKind::kWaiting:
      return doing->task ? "o" + task_style(*doing) : otherwise;
    case GanttKind::kHeld:
      return "o" + task_style(*doing) + " kept";
    case GanttKind::kRecovering:
    case GanttKind::kClosed:
      return "h" + task_style(*doing);
  }
  return otherwise;
}

std::string line_style_of(const std::optional<GanttInterval>& doing) {
  return doing && doing->task ? "k" + task_style(*doing) : "loose";
}

Shape shape_of(const LogHeader& header, const std::string& name, double scale) {
  const LogKind kind = kind_named(header, name);
  Shape shape;
  if (!kind.outline_m.empty()) {
    double reach = 0.0;
    for (const Point2 corner : kind.outline_m) {
      reach = std::max(reach, std::hypot(corner.x_m, corner.y_m));
    }
    const double largest = kLargestShape / 2.0 / std::max(reach, 1e-6);
    const double factor =
        std::min(largest, std::max(scale, kSmallestShape / 2.0 / std::max(reach, 1e-6)));
    for (const Point2 corner : kind.outline_m) {
      shape.outline.push_back({corner.x_m * factor, -corner.y_m * factor});
    }
    shape.length = shape.width = 2.0 * reach * factor;
    return shape;
  }
  if (kind.footprint_m.size() == 2) {
    const double length = std::abs(kind.footprint_m[0]);
    const double width = std::abs(kind.footprint_m[1]);
    const double longest = std::max({length, width, 1e-6});
    const double factor =
        std::min(kLargestShape / longest, std::max(scale, kSmallestShape / longest));
    shape.length = std::max(length * factor, 4.0);
    shape.width = std::max(width * factor, 4.0);
    return shape;
  }
  shape.round = true;
  shape.length = shape.width =
      std::clamp(2.0 * kind.radius_m * scale, kSmallestDisc, kLargestShape);
  return shape;
}

std::string worker_mark(const Shape& shape, const std::string& style) {
  const double front = shape.length / 2.0;
  const double side = shape.width / 2.0;
  if (shape.round) {
    return fmt::format(
        "<path class=\"body {0}\" d=\"M{1} {2}L{3} 0L{1} {4}Z\"/><circle class=\"under\" "
        "r=\"{5}\"/><circle class=\"body {0}\" r=\"{5}\"/>",
        style, coordinate(front * 0.45), coordinate(-front * 0.9), coordinate(front + 5.0),
        coordinate(front * 0.9), coordinate(front));
  }
  std::string data;
  for (const routes::Pixel corner : shape.outline) {
    data += fmt::format("{}{} {}", data.empty() ? "M" : "L", coordinate(corner.x),
                        coordinate(corner.y));
  }
  if (data.empty()) {
    data = fmt::format("M{0} {1}H{2}V{3}H{0}", coordinate(-front), coordinate(-side),
                       coordinate(front), coordinate(side));
  }
  const double arrow = std::min(side * 0.55, 5.0);
  return fmt::format(
      "<path class=\"under\" d=\"{0}Z\"/><path class=\"body {1}\" d=\"{0}Z\"/>"
      "<path class=\"front\" d=\"M{2} {3}L{4} 0L{2} {5}\"/>",
      data, style, coordinate(front - 3.0 - arrow), coordinate(-arrow), coordinate(front - 3.0),
      coordinate(arrow));
}

double TokenMark::width() const {
  if (capacity && *capacity <= kMostSquares) {
    return kTokenStep * static_cast<double>(std::max<std::int64_t>(*capacity, 1));
  }
  return kTokenStep + 2.0 + markup::text_width(std::to_string(count), kNumberSize);
}

std::string TokenMark::svg() const {
  const auto square = [](std::int64_t at, bool full) {
    return fmt::format("<rect class=\"{}\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>",
                       full ? "full" : "hole", coordinate(static_cast<double>(at) * kTokenStep),
                       coordinate(-kTokenSize), coordinate(kTokenSize), coordinate(kTokenSize));
  };
  if (!capacity || *capacity > kMostSquares) {
    return square(0, count > 0) + fmt::format("<text class=\"st\" x=\"{}\">{}</text>",
                                              coordinate(kTokenStep + 2.0), count);
  }
  std::string svg;
  for (std::int64_t i = 0; i < *capacity; ++i) svg += square(i, i < count);
  return svg;
}

}  // namespace linewright::hall
