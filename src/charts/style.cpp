#include <fmt/format.h>

#include <array>
#include <string>

#include "linewright/charts/chart.hpp"

// Classes, with i the number of a style: `lw-s<i>` stroke, `lw-f<i>` fill and `lw-d<i>` dashes.
namespace linewright {
namespace {

using Palette = std::array<const char*, kChartStyles>;

// Seven are Okabe and Ito's, but for yellow, which does not show on white; the others keep away
// from them in hue or lightness. In order: blue, vermilion, green, purple, orange, sky, ink,
// violet, brown, olive, grey, wine.
constexpr Palette kLight = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9",
                            "#222a33", "#7a4fd0", "#8a5a33", "#8a8f1a", "#8795a3", "#8c1c4e"};
// On dark ground the dark ones need lifting, and what was near to them as well.
constexpr Palette kDark = {"#3a96db", "#f0742e", "#1fb58a", "#dd95bd", "#f2b33d", "#93d5fb",
                           "#eef2f6", "#a98bf5", "#b98a62", "#b9bf4a", "#8593a1", "#d0487f"};

// No two alike, so that lines differ in black and white.
constexpr std::array<const char*, kChartStyles> kDashes = {
    "none",      "9 4",      "2.5 3", "9 3 2.5 3",  "5 3",          "16 4", "9 3 2.5 3 2.5 3",
    "5 3 2.5 3", "16 3 5 3", "2.5 6", "16 3 2.5 3", "5 3 5 3 2.5 3"};

constexpr const char* kCommonRules = R"css(
.lw-chart{max-width:100%;height:auto}
.lw-chart text{font-family:system-ui,-apple-system,"Segoe UI",Roboto,"Noto Sans","Helvetica Neue",Arial,sans-serif;font-size:14px;font-variant-numeric:tabular-nums}
.lw-chart .lw-title{font-size:17px;font-weight:650}.lw-chart .lw-none{font-size:17px}
.lw-mid{text-anchor:middle}.lw-end{text-anchor:end}
.lw-grid,.lw-axis{stroke-width:1;fill:none}
.lw-line{fill:none;stroke-width:2.2;stroke-linejoin:round}
.lw-band{fill-opacity:.17;stroke:none}.lw-area{fill-opacity:.07;stroke:none}
.lw-marker{stroke-width:1;stroke-linejoin:round}.lw-open{stroke-width:2}
.lw-bar{stroke:none}.lw-hatch{fill:none;stroke-width:1.3;stroke-opacity:.75}
.lw-whisker{fill:none;stroke-width:1.4}.lw-edge{fill:none;stroke-width:3.2;stroke-opacity:.7}
.lw-ref{fill:none;stroke-width:1.5}.lw-diamond{stroke-width:1.4}
.lw-halo{stroke-width:4px;paint-order:stroke;stroke-linejoin:round}
)css";

constexpr const char* kLightRules = R"css(
.lw-paper{fill:#fff}.lw-ink{fill:#18212b}.lw-muted{fill:#46525f}
.lw-grid{stroke:#e1e6eb}.lw-axis{stroke:#5b6876}.lw-whisker,.lw-ref{stroke:#18212b}
.lw-marker,.lw-hatch,.lw-halo,.lw-edge{stroke:#fff}.lw-open,.lw-chart .lw-diamond{fill:#fff}.lw-diamond{stroke:#18212b}
)css";
constexpr const char* kDarkRules = R"css(
.lw-paper{fill:#12161b}.lw-ink{fill:#e9eef3}.lw-muted{fill:#b3beca}
.lw-grid{stroke:#29323b}.lw-axis{stroke:#8491a0}.lw-whisker,.lw-ref{stroke:#e9eef3}
.lw-marker,.lw-hatch,.lw-halo,.lw-edge{stroke:#12161b}.lw-open,.lw-chart .lw-diamond{fill:#12161b}.lw-diamond{stroke:#e9eef3}
)css";

std::string colours(const Palette& palette) {
  std::string css;
  for (std::size_t i = 0; i < palette.size(); ++i) {
    css += fmt::format(".lw-s{0}{{stroke:{1}}}.lw-f{0}{{fill:{1}}}\n", i, palette[i]);
  }
  return css;
}

}  // namespace

std::string charts_style_sheet() {
  std::string css = kCommonRules;
  for (std::size_t i = 0; i < kDashes.size(); ++i) {
    css += fmt::format(".lw-d{}{{stroke-dasharray:{}}}", i, kDashes[i]);
  }
  css += kLightRules + colours(kLight);
  // On paper the chart is always light.
  return css + fmt::format("@media screen and (prefers-color-scheme:dark){{{}{}}}\n", kDarkRules,
                           colours(kDark));
}

}  // namespace linewright
