#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

// The parts that all charts are drawn of. Looks are classes of the style sheet; see style.cpp.
namespace linewright::charts {

inline constexpr double kTickSize = 14.0;   ///< of the numbers at axes, and of the legend
inline constexpr double kTitleSize = 17.0;  ///< of the chart's title
inline constexpr double kSampleWidth = 36.0;

struct Point {
  double x = 0.0;
  double y = 0.0;
};

/// Upright, y grows downwards: left <= right, top <= bottom.
struct Box {
  double left = 0.0;
  double top = 0.0;
  double right = 0.0;
  double bottom = 0.0;

  [[nodiscard]] double width() const { return right - left; }
  [[nodiscard]] double height() const { return bottom - top; }
  [[nodiscard]] bool contains(Point p) const;
  [[nodiscard]] bool meets(const Box& other) const;  ///< more than edges
};

/// A coordinate as text. Those far outside of any chart stay near enough for every renderer.
[[nodiscard]] std::string at(double value);

/// "x y", for paths.
[[nodiscard]] std::string pair(Point p);

/// A class of the style sheet: `kind` and the number of the style.
[[nodiscard]] std::string style_class(char kind, std::size_t style);

/// Text at its base line. `look` are classes, `words` are not yet escaped.
[[nodiscard]] std::string text(std::string_view look, Point p, std::string_view words);

/// A straight line.
[[nodiscard]] std::string line(std::string_view look, Point from, Point to);

/// The style's marker around a point. `tip` shows on hovering; not yet escaped.
[[nodiscard]] std::string marker(std::size_t style, Point p, std::string_view tip = "");

enum class Fill { kHatched, kPlain };

/// A filled bar, perhaps with the style's hatching.
[[nodiscard]] std::string bar(std::size_t style, const Box& box, Fill fill,
                              std::string_view tip = "");

/// The small diamond of a reference value, as wide as `width` allows.
[[nodiscard]] std::string diamond(Point p, double width, std::string_view tip = "");

/// The dashes of the n-th reference line.
[[nodiscard]] std::string reference_look(std::size_t n, std::optional<std::size_t> style);

/// What is inside of the box, and nothing outside of it.
[[nodiscard]] std::string clipped(const Box& box, std::string_view svg);

}  // namespace linewright::charts
