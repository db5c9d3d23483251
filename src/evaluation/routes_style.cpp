#include "routes_style.hpp"

#include <fmt/format.h>

#include "gantt_style.hpp"

namespace linewright::routes {
namespace {

constexpr const char* kRules = R"css(
.way{fill:none;stroke-linejoin:round;stroke-linecap:round}.back{stroke-dasharray:4 3.2;stroke-linecap:butt}
.panel{font-size:14px;font-weight:650}.facts{font-weight:400}.place{font-size:11px;stroke-width:3px;paint-order:stroke;stroke-linejoin:round}
.floor{stroke:none}.wall{fill:none;stroke-width:1.2}.block{stroke-width:.8}.tick{stroke-width:1.6;fill:none;stroke-linecap:round}
.stop{stroke-width:1.2}.start{fill:none;stroke-width:1.6}.cross{fill:none;stroke-width:1.6}.lead{fill:none;stroke-width:.9}.bar-line{fill:none;stroke-width:1.4}
)css";
constexpr const char* kLightRules =
    ".floor{fill:#fff}.wall{stroke:#5b6876}.block,.cells{fill:#dde3e9}.block{stroke:#b7c1cb}"
    ".unknown{fill:#eff2f5}.tick,.start,.bar-line{stroke:#18212b}.stop{stroke:#fff}"
    ".missing{fill:#fff;stroke:#5b6876}.cross{stroke:#c22f1e}.lead{stroke:#8795a4}"
    ".place{fill:#18212b;stroke:#fff}.mark{fill:#18212b}";
constexpr const char* kDarkRules =
    ".floor{fill:#12161b}.wall{stroke:#98a5b3}.block,.cells{fill:#2b343e}.block{stroke:#46525f}"
    ".unknown{fill:#1c2229}.tick,.start,.bar-line{stroke:#e9eef3}.stop{stroke:#12161b}"
    ".missing{fill:#12161b;stroke:#98a5b3}.cross{stroke:#ff7d68}.lead{stroke:#66788a}"
    ".place{fill:#e9eef3;stroke:#12161b}.mark{fill:#e9eef3}";

}  // namespace

std::string style_sheet(std::size_t colours) {
  return gantt::style_sheet(colours) + kRules + kLightRules +
         fmt::format("@media (prefers-color-scheme:dark){{{}}}\n", kDarkRules);
}

}  // namespace linewright::routes
