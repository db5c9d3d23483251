#pragma once

#include <string>
#include <vector>

#include "hall_marks.hpp"
#include "label_places.hpp"
#include "routes_view.hpp"

namespace linewright::hall {

/// A name beside what it names, with the material there.
struct Label {
  std::string text;
  bool strong = false;  ///< of something that moves
  std::vector<TokenMark> tokens;
  routes::Pixel at;  ///< the middle of what it names
  double dot = 0.0;  ///< and its radius

  [[nodiscard]] double width() const;
};

/// All names, placed so that they cover neither each other nor what they name as far as there is
/// room. Only the first few hundred are drawn. To be called once per placer.
[[nodiscard]] std::string labels_svg(const std::vector<Label>& labels, labels::Placer& placer);

}  // namespace linewright::hall
