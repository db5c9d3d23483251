#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>

// What all charts have in common.
//
// A chart is one SVG without scripts, ids, fonts or links: it stands alone, and one HTML page can
// hold any number of them. It is light, dark where the viewer prefers that on a screen, and has its
// own ground. All text comes unescaped. The same chart gives the same bytes on every machine. A
// value that is not finite, or beyond +-1e15, counts as missing: lines have a gap, bars are absent.
namespace linewright {

/// A value that is not there.
inline constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

/// A style is a colour with a dash pattern, a shape of marker and a hatching of its own, so that
/// series also differ in black and white. Give what has one name one style in all charts; styles
/// beyond this many look like earlier ones.
inline constexpr std::size_t kChartStyles = 12;

/// Around any chart. Lengths are in units of which the text of the axes is 14 high: at the usual
/// width it reads well on a screen and in a column of 8 cm.
struct ChartFrame {
  std::string title;        ///< above the chart, at most two lines; empty: none
  std::string description;  ///< for those who do not see the picture; empty: the title again
  double width = 640.0;     ///< 320 ... 4000
  double height = 400.0;    ///< 200 ... 4000; a chart with a large legend becomes higher
  bool with_style = true;   ///< false: the page around has charts_style_sheet() in a <style>
};

/// An axis of numbers.
struct ChartAxis {
  std::string title;
  std::string unit;            ///< follows each number, e.g. " %"
  std::optional<double> low;   ///< none: from the data. Ignored when not below `high`.
  std::optional<double> high;  ///< none: from the data. What lies outside is cut off.
  bool integer = false;        ///< counts: no ticks between whole numbers
};

/// A line across the chart at one value, e.g. "tuned priority list 797". Its label stands at the
/// line where it hides no data, and else in the legend.
struct ReferenceLine {
  double value = 0.0;
  std::string label;
  std::optional<std::size_t> style;  ///< gives the colour; none: the colour of text
};

/// The CSS of all charts, for pages that hold several of them. Its classes begin with `lw-`.
[[nodiscard]] std::string charts_style_sheet();

}  // namespace linewright
