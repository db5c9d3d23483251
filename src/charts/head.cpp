#include "head.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "drawing.hpp"
#include "linewright/base/markup.hpp"

namespace linewright::charts {
namespace {

using markup::escaped;
using markup::text_width;

constexpr double kLegendLine = 21.0;
constexpr double kTitleLine = 22.0;
constexpr double kToName = 7.0;     // from the sample
constexpr double kToSample = 20.0;  // from the name before

double sound_length(double length, double least, double usual) {
  return std::isfinite(length) ? std::clamp(length, least, 4000.0) : usual;
}

double entry_width(const LegendEntry& entry) {
  return entry.width + kToName + text_width(entry.name, kTickSize) + kToSample;
}

/// Left ends of the entries, and their lines.
std::vector<Point> flowing(const std::vector<LegendEntry>& entries, double width) {
  std::vector<Point> places;
  Point place;
  for (const LegendEntry& entry : entries) {
    const double needed = entry_width(entry);
    if (place.x > 0.0 && place.x + needed - kToSample > width) place = {0.0, place.y + 1.0};
    places.push_back(place);
    place.x += needed;
  }
  return places;
}

/// The same in columns, which read more easily.
std::vector<Point> in_columns(const std::vector<LegendEntry>& entries, double width) {
  double widest = 0.0;
  for (const LegendEntry& entry : entries) widest = std::max(widest, entry_width(entry));
  const double fitting = std::max(1.0, std::floor((width + kToSample) / widest));
  std::vector<Point> places;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const double row = std::floor(static_cast<double>(i) / fitting);
    places.push_back({(static_cast<double>(i) - row * fitting) * widest, row});
  }
  return places;
}

std::vector<Point> places_of(const std::vector<LegendEntry>& entries, double width) {
  std::vector<Point> flow = flowing(entries, width);
  if (entries.empty() || flow.back().y == 0.0) return flow;
  std::vector<Point> columns = in_columns(entries, width);
  return columns.back().y <= flow.back().y ? columns : flow;
}

std::vector<LegendEntry> named(const std::vector<LegendEntry>& legend, double width) {
  std::vector<LegendEntry> entries;
  for (const LegendEntry& entry : legend) {
    if (entry.name.empty()) continue;
    const double room = width - entry.width - kToName;
    entries.push_back({entry.sample, markup::shortened(entry.name, room, kTickSize), entry.width});
  }
  return entries;
}

/// Draws the legend from `head.bottom` on.
void add_legend(Head& head, const std::vector<LegendEntry>& entries, double width) {
  const std::vector<Point> places = places_of(entries, width);
  if (places.empty()) return;
  head.svg += "<g class=\"lw-legend\">\n";
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const Point middle{kMargin + places[i].x, head.bottom + (places[i].y + 0.5) * kLegendLine};
    head.svg +=
        fmt::format("<g transform=\"translate({})\">\n{}</g>\n", pair(middle), entries[i].sample);
    head.svg += text("lw-legend-name lw-ink",
                     {middle.x + entries[i].width + kToName, middle.y + 5.0}, entries[i].name);
  }
  head.svg += "</g>\n";
  head.bottom += (places.back().y + 1.0) * kLegendLine;
}

/// How many bytes a line can take before the last place to break it; 0 when there is none.
std::size_t first_line(std::string_view words, double width, double font_size) {
  std::size_t length = 0;
  for (std::size_t at = words.find_first_of(" _:-/"); at != std::string_view::npos;
       at = words.find_first_of(" _:-/", at + 1)) {
    const std::size_t end = words[at] == ' ' ? at : at + 1;
    if (text_width(words.substr(0, end), font_size) > width) break;
    length = end;
  }
  return length;
}

}  // namespace

std::vector<std::string> wrapped(std::string_view words, double width, double font_size,
                                 std::size_t lines) {
  std::vector<std::string> result;
  while (text_width(words, font_size) > width && result.size() + 1 < lines) {
    const std::size_t length = first_line(words, width, font_size);
    if (length == 0) break;
    result.emplace_back(words.substr(0, length));
    words.remove_prefix(length);
    if (words.starts_with(' ')) words.remove_prefix(1);
  }
  if (!words.empty()) result.push_back(markup::shortened(words, width, font_size));
  return result;
}

ChartFrame sound(const ChartFrame& frame) {
  ChartFrame result = frame;
  result.width = sound_length(frame.width, 320.0, ChartFrame{}.width);
  result.height = sound_length(frame.height, 200.0, ChartFrame{}.height);
  return result;
}

Head draw_head(const ChartFrame& frame, const std::vector<LegendEntry>& legend) {
  const double width = frame.width - 2.0 * kMargin;
  Head head{"", kMargin - 2.0};
  // Titles are bold, which is wider.
  for (const std::string& line : wrapped(frame.title, width / 1.06, kTitleSize, 2)) {
    head.bottom += kTitleLine;
    head.svg += text("lw-title lw-ink", {kMargin, head.bottom - 5.0}, line);
  }
  if (!frame.title.empty()) head.bottom += 5.0;
  add_legend(head, named(legend, width), width);
  return head;
}

std::string document(const ChartFrame& frame, double height, std::string_view body) {
  const std::string& description = frame.description.empty() ? frame.title : frame.description;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"lw-chart\" width=\"{0}\" height=\"{1}\" "
      "viewBox=\"0 0 {0} {1}\" role=\"img\">\n<title>{2}</title>\n<desc>{3}</desc>\n",
      at(frame.width), at(height), escaped(frame.title), escaped(description));
  if (frame.with_style) svg += fmt::format("<style>{}</style>\n", charts_style_sheet());
  svg += "<rect class=\"lw-paper\" width=\"100%\" height=\"100%\"/>\n";
  return svg + fmt::format("{}</svg>\n", body);
}

}  // namespace linewright::charts
