#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "drawing.hpp"
#include "linewright/charts/chart.hpp"

// What stands above every chart, and the document around it.
namespace linewright::charts {

inline constexpr double kMargin = 14.0;

/// One entry of the legend. The sample is drawn to the right of the origin, within 7 up and down.
struct LegendEntry {
  std::string sample;
  std::string name;
  double width = kSampleWidth;  ///< of the sample
};

/// Title and legend, which wraps; nothing of it is below `bottom`.
struct Head {
  std::string svg;
  double bottom = 0.0;
};

/// The frame with lengths that can be drawn.
[[nodiscard]] ChartFrame sound(const ChartFrame& frame);

/// Of a sound frame. Entries without a name are left out.
[[nodiscard]] Head draw_head(const ChartFrame& frame, const std::vector<LegendEntry>& legend);

/// The SVG of a sound frame. The body is everything but the ground.
[[nodiscard]] std::string document(const ChartFrame& frame, double height, std::string_view body);

/// The words in at most `lines` lines about `width` wide, broken at blanks or after _ : - /, and
/// the rest left out.
[[nodiscard]] std::vector<std::string> wrapped(std::string_view words, double width,
                                               double font_size, std::size_t lines);

}  // namespace linewright::charts
