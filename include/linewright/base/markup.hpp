#pragma once

#include <cstddef>
#include <string>
#include <string_view>

// Text in SVG and HTML.
namespace linewright::markup {

/// Safe as XML or HTML text and within quoted attributes: markup characters become entities, white
/// space becomes blanks, and what XML cannot hold becomes U+FFFD.
[[nodiscard]] std::string escaped(std::string_view text);

/// About how wide the text is drawn in a usual sans-serif face of the given size, rather too wide.
[[nodiscard]] double text_width(std::string_view text, double font_size);

/// The text, or as much of it as is about `width` wide, with an ellipsis.
[[nodiscard]] std::string shortened(std::string_view text, double width, double font_size);

/// A coordinate: at most two decimals, no needless zeros, independent of the locale.
[[nodiscard]] std::string coordinate(double value);

}  // namespace linewright::markup
