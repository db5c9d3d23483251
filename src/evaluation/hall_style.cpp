#include "hall_style.hpp"

#include <fmt/format.h>

namespace linewright::hall {

std::string style_rules() {
  constexpr const char* kRules =
      ".who{font-size:11.5px;font-weight:650}.st{font-size:10.5px}.who,.st{stroke-width:3px;"
      "paint-order:stroke;stroke-linejoin:round}.body{stroke-width:1.4;stroke-opacity:1;stroke-"
      "linejoin:round}"
      ".front{fill:none;stroke-width:1.8;stroke-linecap:round;stroke-linejoin:round}"
      ".carrier{fill:none;stroke-width:1.6}.carrier.loose{stroke-dasharray:4 2.5}"
      ".ahead{fill:none;stroke-width:2.4;stroke-linejoin:round;stroke-linecap:round}"
      ".casing{fill:none;stroke-width:4.2;stroke-opacity:.5;stroke-linejoin:round;stroke-linecap:"
      "round}"
      ".ahead.loose{stroke-dasharray:1 5}"
      ".head-of-way{fill:none;stroke-width:2.4;stroke-linejoin:round;stroke-linecap:round}"
      ".station{stroke-width:1.2}.link{fill:none;stroke-dasharray:1.5 3}"
      ".zone{fill:none;stroke-dasharray:7 4}.shut{stroke-width:1.6}"
      ".number{font-size:10px;font-weight:650;text-anchor:middle}.machine{stroke-width:1}.kept{"
      "stroke-width:2.2;stroke-opacity:1}";
  constexpr const char* kLight =
      ".under{fill:#fff}.free{fill:#fff;stroke:#18212b}.front,.held{stroke:#18212b}.loose{stroke:#"
      "5b6876}"
      ".station{fill:#fff;stroke:#5b6876}.link{stroke:#8795a4}.full{fill:#18212b}"
      ".hole{fill:#fff;stroke:#8795a4;stroke-width:.8}.who{fill:#18212b;stroke:#fff}"
      ".st{fill:#44505d;stroke:#fff}.zone{stroke:#8795a4}"
      ".shut{fill:#d55e00;fill-opacity:.14;stroke:#b34700}"
      ".idle{fill:#f7f9fb;stroke:#8795a4}.done{fill:#18212b}.track{fill:#fff;fill-opacity:.75}"
      ".number{fill:#18212b}.casing{stroke:#18212b}";
  constexpr const char* kDark =
      ".under{fill:#12161b}.free{fill:#12161b;stroke:#e9eef3}.front,.held{stroke:#e9eef3}.loose{"
      "stroke:#98a5b3}"
      ".station{fill:#12161b;stroke:#98a5b3}.link{stroke:#66788a}.full{fill:#e9eef3}"
      ".hole{fill:#12161b;stroke:#66788a;stroke-width:.8}.who{fill:#e9eef3;stroke:#12161b}"
      ".st{fill:#b4bfca;stroke:#12161b}.zone{stroke:#66788a}"
      ".shut{fill:#d55e00;fill-opacity:.28;stroke:#ff8f45}"
      ".idle{fill:#1c2229;stroke:#66788a}.done{fill:#e9eef3}.track{fill:#12161b;fill-opacity:.7}"
      ".number{fill:#e9eef3}.casing{stroke:#e9eef3}";
  return fmt::format("{}{}@media (prefers-color-scheme:dark){{{}}}\n", kRules, kLight, kDark);
}

}  // namespace linewright::hall
