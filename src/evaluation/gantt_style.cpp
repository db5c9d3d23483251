#include "gantt_style.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace linewright::gantt {
namespace {

struct Colour {
  double r = 0.0;
  double g = 0.0;
  double b = 0.0;
};

constexpr Colour colour(std::uint32_t rgb) {
  return {static_cast<double>((rgb >> 16U) & 0xFFU), static_cast<double>((rgb >> 8U) & 0xFFU),
          static_cast<double>(rgb & 0xFFU)};
}

constexpr Colour kWhite = colour(0xFFFFFF);
constexpr Colour kBlack = colour(0x000000);

// The first seven are Okabe and Ito's. The others were chosen for their distance from all before
// them under normal vision and under simulated protanopia, deuteranopia and tritanopia.
constexpr std::array<std::uint32_t, 12> kLight = {0xE69F00, 0x56B4E9, 0x009E73, 0xCC79A7,
                                                  0x0072B2, 0xD55E00, 0xF0E442, 0x8F5BE8,
                                                  0x6B2A0B, 0xAACCAA, 0x1B2F80, 0x7A5C5C};
// On dark ground the darkest need lifting.
constexpr std::array<std::uint32_t, 12> kDark = {0xE69F00, 0x56B4E9, 0x009E73, 0xCC79A7,
                                                 0x0B7FC4, 0xD55E00, 0xF0E442, 0xA276F2,
                                                 0x9A5230, 0xB4D6B4, 0x4659CC, 0x8C7272};
static_assert(kStyles == 3 * kLight.size() && kLight.size() == kDark.size());

Colour mix(Colour a, Colour b, double share_of_b) {
  const auto part = [&](double x, double y) { return x + (y - x) * share_of_b; };
  return {part(a.r, b.r), part(a.g, b.g), part(a.b, b.b)};
}

std::string hex(Colour c) {
  return fmt::format("#{:02x}{:02x}{:02x}", std::lround(c.r), std::lround(c.g), std::lround(c.b));
}

/// Relative luminance, WCAG 2.
double luminance(Colour c) {
  const auto linear = [](double value) {
    const double v = value / 255.0;
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(c.r) + 0.7152 * linear(c.g) + 0.0722 * linear(c.b);
}

/// Black or white, whichever reads better on `ground`.
Colour ink_on(Colour ground) { return luminance(ground) > 0.18 ? colour(0x10151B) : kWhite; }

/// What differs between light and dark.
struct Theme {
  const std::array<std::uint32_t, 12>& palette;
  Colour edge;        ///< bars' edges are mixed with this
  Colour machine;     ///< operations that belong to no task
  const char* rules;  ///< everything without a task
};

constexpr const char* kLightRules = R"css(
.bg{fill:#fff}.ink{fill:#18212b}.muted{fill:#5b6876}.grid{stroke:#e4e9ee}.axis{stroke:#b7c1cb}
.stripe{fill:#f6f8fa}.finish{stroke:#18212b}.halo{fill:#18212b;stroke:#fff}.mark{fill:#5b6876}
.failed .finish{stroke:#c22f1e}.failed .ink{fill:#c22f1e}
)css";
constexpr const char* kDarkRules = R"css(
.bg{fill:#12161b}.ink{fill:#e9eef3}.muted{fill:#98a5b3}.grid{stroke:#262e37}.axis{stroke:#46525f}
.stripe{fill:#181d23}.finish{stroke:#e9eef3}.halo{fill:#e9eef3;stroke:#12161b}.mark{fill:#98a5b3}
.failed .finish{stroke:#ff7d68}.failed .ink{fill:#ff7d68}
)css";

const Theme& light() {
  static const Theme kTheme{kLight, kBlack, colour(0x8795A4), kLightRules};
  return kTheme;
}

const Theme& dark() {
  static const Theme kTheme{kDark, kWhite, colour(0x66788A), kDarkRules};
  return kTheme;
}

/// The palette, then lighter, then darker once more.
Colour task_colour(const Theme& theme, std::size_t style) {
  const Colour base = colour(theme.palette[style % theme.palette.size()]);
  const std::size_t round = style / theme.palette.size();
  return round == 0 ? base : mix(base, round == 1 ? kWhite : kBlack, round == 1 ? 0.5 : 0.4);
}

std::string rules_of(const std::string& name, Colour fill, const Theme& theme) {
  const std::string edge = hex(mix(fill, theme.edge, 0.28));
  return fmt::format(
      ".s{0}{{fill:{1};stroke:{2}}}.h{0}{{fill:url(#lw-h{0});stroke:{2}}}"
      ".o{0}{{fill:{1};fill-opacity:.13;stroke:{2};stroke-opacity:.55}}"
      ".g{0}{{fill:{1};fill-opacity:.3}}.k{0}{{stroke:{1}}}.l{0}{{fill:{3}}}\n",
      name, hex(fill), edge, hex(ink_on(fill)));
}

std::string theme_rules(const Theme& theme, std::size_t tasks) {
  std::string css = theme.rules + rules_of("n", theme.machine, theme);
  for (std::size_t i = 0; i < std::min(tasks, kStyles); ++i) {
    css += rules_of(std::to_string(i), task_colour(theme, i), theme);
  }
  return css;
}

std::string hatching(const std::string& name) {
  return fmt::format(
      "<pattern id=\"lw-h{0}\" width=\"5\" height=\"5\" patternUnits=\"userSpaceOnUse\" "
      "patternTransform=\"rotate(45)\"><rect class=\"g{0}\" width=\"5\" height=\"5\"/>"
      "<path class=\"k{0}\" d=\"M1.25 0v5\" stroke-width=\"2.2\"/></pattern>\n",
      name);
}

constexpr const char* kCommonRules = R"css(
text{font-family:system-ui,-apple-system,"Segoe UI",Roboto,"Noto Sans","Helvetica Neue",Arial,sans-serif;font-size:12px}
.small{font-size:10px}.title{font-size:20px;font-weight:650}.head{font-size:11px;font-weight:650;letter-spacing:.04em}
.grid,.axis{stroke-width:1;shape-rendering:crispEdges}.finish{stroke-width:1.5}
.bar{stroke-width:.75}.name{font-size:10px;text-anchor:middle;pointer-events:none}
.halo{stroke-width:3px;paint-order:stroke;stroke-linejoin:round}
.end{text-anchor:end}.mid{text-anchor:middle}.strong{font-weight:650}
)css";

}  // namespace

std::string style_sheet(std::size_t tasks) {
  return fmt::format("{}{}@media (prefers-color-scheme:dark){{{}}}\n", kCommonRules,
                     theme_rules(light(), tasks), theme_rules(dark(), tasks));
}

std::string hatchings(std::size_t tasks) {
  std::string defs = "<defs>\n" + hatching("n");
  for (std::size_t i = 0; i < std::min(tasks, kStyles); ++i) defs += hatching(std::to_string(i));
  return defs + "</defs>\n";
}

}  // namespace linewright::gantt
