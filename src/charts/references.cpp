#include "references.hpp"

#include <algorithm>
#include <optional>

#include "linewright/base/markup.hpp"

namespace linewright::charts {
namespace {

/// A label of the given width at the line: above or below it; right, left, or between.
std::vector<Box> places_at(const Plot& plot, double y, double width) {
  std::vector<Box> places;
  const double room = plot.box.width() - width;
  for (const double share : {1.0, 0.0, 0.5, 0.75, 0.25}) {
    const double left = plot.box.left + 4.0 + share * (room - 8.0);
    places.push_back({left, y - kTickSize - 5.0, left + width, y - 2.0});
    places.push_back({left, y + 2.0, left + width, y + kTickSize + 5.0});
  }
  return places;
}

bool within(const Box& place, const Box& plot) {
  return place.left >= plot.left && place.right <= plot.right && place.top >= plot.top - 8.0 &&
         place.bottom <= plot.bottom;
}

/// The first place that meets nothing taken.
std::optional<Box> free_place(const Plot& plot, double y, double width,
                              const std::vector<Box>& taken) {
  for (const Box& place : places_at(plot, y, width)) {
    const auto meets = [&](const Box& other) { return place.meets(other); };
    if (within(place, plot.box) && std::none_of(taken.begin(), taken.end(), meets)) return place;
  }
  return std::nullopt;
}

}  // namespace

void References::add_to(Range& range) const {
  for (const ReferenceLine& reference : lines_) range.add(reference.value);
}

std::vector<Box> References::others(const Plot& plot, std::size_t of) const {
  constexpr double kNear = 4.0;
  std::vector<Box> boxes;
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    if (i == of || !plot.shows(lines_[i].value)) continue;
    const double y = plot.at_y(lines_[i].value);
    boxes.push_back({plot.box.left, y - kNear, plot.box.right, y + kNear});
  }
  return boxes;
}

bool References::place(const Plot& plot, const std::vector<Box>& data) {
  std::vector<Box> used = data;
  labels_.clear();
  bool placed = true;
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    const ReferenceLine& reference = lines_[i];
    if (in_legend_[i] || !plot.shows(reference.value) || reference.label.empty()) continue;
    const double width = markup::text_width(reference.label, kTickSize);
    std::vector<Box> taken = others(plot, i);
    taken.insert(taken.end(), used.begin(), used.end());
    const auto place = free_place(plot, plot.at_y(reference.value), width, taken);
    if (place) {
      used.push_back(*place);
      labels_ += text("lw-halo lw-ink", {place->left, place->bottom - 4.5}, reference.label);
    } else {
      in_legend_[i] = true;
      placed = false;
    }
  }
  return placed;
}

std::vector<LegendEntry> References::legend() const {
  std::vector<LegendEntry> entries;
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    if (!in_legend_[i]) continue;
    entries.push_back(
        {line(reference_look(i, lines_[i].style), {}, {kSampleWidth, 0.0}), lines_[i].label});
  }
  return entries;
}

std::string References::draw_lines(const Plot& plot) const {
  std::string svg;
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    if (!plot.shows(lines_[i].value)) continue;
    const double y = plot.at_y(lines_[i].value);
    svg += line(reference_look(i, lines_[i].style), {plot.box.left, y}, {plot.box.right, y});
  }
  return svg;
}

}  // namespace linewright::charts
