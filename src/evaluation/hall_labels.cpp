#include "hall_labels.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "linewright/base/markup.hpp"

namespace linewright::hall {
namespace {

using markup::coordinate;

constexpr double kNameSize = 10.5;
constexpr double kStrongSize = 11.5;
constexpr double kHeight = 13.0;
constexpr double kWidest = 150.0;
constexpr double kNarrowest = 10.0;    // a name may be empty
constexpr double kLargestDot = 100.0;  // names stand on what is larger
constexpr double kTokenGap = 5.0;
constexpr std::size_t kMostNames = 250;  // placing names takes time with the square of them

double size_of(const Label& label) { return label.strong ? kStrongSize : kNameSize; }

std::string name_of(const Label& label) {
  return markup::shortened(label.text, kWidest, size_of(label));
}

double name_width(const Label& label) {
  return markup::text_width(name_of(label), size_of(label)) * (label.strong ? 1.15 : 1.0);
}

std::string label_svg(const Label& label, const labels::Box& box) {
  const double baseline = box.y1 - 3.2;
  std::string svg =
      fmt::format("<text class=\"{}\" x=\"{}\" y=\"{}\">{}</text>\n", label.strong ? "who" : "st",
                  coordinate(box.x0), coordinate(baseline), markup::escaped(name_of(label)));
  double x = box.x0 + name_width(label) + kTokenGap;
  for (const TokenMark& token : label.tokens) {
    svg += fmt::format("<g transform=\"translate({} {})\">{}</g>\n", coordinate(x),
                       coordinate(baseline - 1.0), token.svg());
    x += token.width() + kTokenGap;
  }
  return svg;
}

}  // namespace

double Label::width() const {
  double sum = name_width(*this);
  for (const TokenMark& token : tokens) sum += kTokenGap + token.width();
  return sum;
}

std::string labels_svg(const std::vector<Label>& labels, labels::Placer& placer) {
  const std::size_t count = std::min(labels.size(), kMostNames);
  std::vector<labels::Anchor> anchors;
  for (std::size_t i = 0; i < count; ++i) {
    const Label& label = labels[i];
    anchors.push_back({label.at.x, label.at.y, std::min(label.dot, kLargestDot),
                       std::max(label.width(), kNarrowest), kHeight});
  }
  const std::vector<labels::Place> places = placer.place(anchors);
  std::string leads;
  std::string texts;
  for (std::size_t i = 0; i < count; ++i) {
    const labels::Place& place = places[i];
    if (place.led) {
      leads += fmt::format("<path class=\"lead\" d=\"M{} {}L{} {}\"/>\n", coordinate(place.x),
                           coordinate(place.y), coordinate(place.to_x), coordinate(place.to_y));
    }
    texts += label_svg(labels[i], place.box);
  }
  return leads + texts;
}

}  // namespace linewright::hall
