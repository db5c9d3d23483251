#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "linewright/evaluation/gantt.hpp"
#include "linewright/evaluation/log_document.hpp"
#include "routes_view.hpp"

// The shapes of what moves, and of material, in pictures of the hall.
namespace linewright::hall {

/// The style (gantt_style.hpp) of who or what does this: solid while at work or on the way, faint
/// while waiting or held, hatched while recovering; `otherwise` for who does nothing in a task.
[[nodiscard]] std::string style_of(const std::optional<GanttInterval>& doing,
                                   const std::string& otherwise);

/// The style of lines that belong to it.
[[nodiscard]] std::string line_style_of(const std::optional<GanttInterval>& doing);

/// How a kind of worker is drawn, pixels; never too small to be seen.
struct Shape {
  double length = 0.0;
  double width = 0.0;
  bool round = false;                  ///< a disc of diameter `length`
  std::vector<routes::Pixel> outline;  ///< around the pose, x forward, y left; or empty
};
[[nodiscard]] Shape shape_of(const LogHeader& header, const std::string& kind, double scale);

/// A worker at (0, 0) that looks along +x, with a mark for its front.
[[nodiscard]] std::string worker_mark(const Shape& shape, const std::string& style);

/// Tokens of one kind in one place: squares, or a square and a number where they would be many.
struct TokenMark {
  std::int64_t count = 0;
  std::optional<std::int64_t> capacity;

  [[nodiscard]] double width() const;
  /// From (0, 0) to the right and upwards.
  [[nodiscard]] std::string svg() const;
};

/// Height of a token mark, pixels.
inline constexpr double kTokenSize = 6.0;

}  // namespace linewright::hall
