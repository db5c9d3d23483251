#pragma once

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "../base/xml_check.hpp"

// Reads charts as a viewer would: what stands where. For tests.
namespace linewright::test {

struct Element {
  std::string tag;
  std::map<std::string, std::string> attributes;
  std::string text;  ///< up to the next tag

  [[nodiscard]] double number(const std::string& name) const {
    return std::stod(attributes.at(name));
  }
};

/// The element whose tag begins at `at`. Without regular expressions: those of the standard library
/// recurse once per character, and paths are long.
inline Element element_at(const std::string& svg, std::size_t at) {
  Element element;
  const std::size_t close = svg.find('>', at);
  std::size_t end = svg.find_first_of(" />", at + 1);
  element.tag = svg.substr(at + 1, end - at - 1);
  while (svg[end] == ' ') {
    const std::size_t equals = svg.find('=', end);
    const std::size_t quote = svg.find('"', equals + 2);
    element.attributes[svg.substr(end + 1, equals - end - 1)] =
        svg.substr(equals + 2, quote - equals - 2);
    end = quote + 1;
  }
  element.text = svg.substr(close + 1, svg.find('<', close) - close - 1);
  return element;
}

/// All elements with a class, in order. The text is one that XmlCheck finds nothing wrong with.
inline std::vector<Element> elements(const std::string& svg, const std::string& of_class) {
  std::vector<Element> found;
  for (std::size_t at = svg.find('<'); at != std::string::npos; at = svg.find('<', at + 1)) {
    if (svg[at + 1] == '/') continue;
    Element element = element_at(svg, at);
    const std::string classes = " " + element.attributes["class"] + " ";
    if (classes.find(" " + of_class + " ") != std::string::npos) found.push_back(element);
  }
  return found;
}

/// All numbers in a text, e.g. of a path or a transform.
inline std::vector<double> numbers(const std::string& text) {
  std::vector<double> found;
  for (std::size_t at = text.find_first_of("-0123456789"); at != std::string::npos;
       at = text.find_first_of("-0123456789", at)) {
    std::size_t length = 0;
    found.push_back(std::stod(text.substr(at, 24), &length));
    at += length;
  }
  return found;
}

/// What a tick label says, e.g. "−1,500 %" or "0.2 M".
inline double label_value(std::string label) {
  const bool millions = label.ends_with(" M");
  const bool negative = label.starts_with("−");
  std::erase(label, ',');
  if (negative) label.erase(0, std::string("−").size());
  return std::stod(label) * (millions ? 1e6 : 1.0) * (negative ? -1.0 : 1.0);
}

/// Where an axis shows a value, from the places of its first and last label.
class DrawnAxis {
 public:
  DrawnAxis(const std::string& svg, const std::string& of_class, const std::string& coordinate,
            double shift) {
    const std::vector<Element> ticks = elements(svg, of_class);
    from_ = label_value(ticks.at(0).text);
    to_ = label_value(ticks.back().text);
    at_from_ = ticks.front().number(coordinate) + shift;
    at_to_ = ticks.back().number(coordinate) + shift;
  }

  [[nodiscard]] double place(double value) const {
    return at_from_ + (value - from_) / (to_ - from_) * (at_to_ - at_from_);
  }

 private:
  double from_ = 0.0;
  double to_ = 0.0;
  double at_from_ = 0.0;
  double at_to_ = 0.0;
};

/// Labels stand in the middle of their x, and 5 below their y.
inline DrawnAxis x_axis(const std::string& svg) { return {svg, "lw-tick-x", "x", 0.0}; }
inline DrawnAxis y_axis(const std::string& svg) { return {svg, "lw-tick-y", "y", -5.0}; }

inline std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++found;
  }
  return found;
}

/// Whether a word stands in a text by itself.
inline bool has_word(const std::string& text, const std::string& word) {
  const auto letter = [&](std::size_t i) {
    return i < text.size() && std::isalpha(static_cast<unsigned char>(text[i])) != 0;
  };
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    if (!letter(at - 1) && !letter(at + word.size())) return true;
  }
  return false;
}

/// What is wrong with a chart as a document, or empty.
inline std::string chart_fault(const std::string& svg) {
  const std::string fault = XmlCheck::fault(svg);
  if (!fault.empty()) return fault;
  if (has_word(svg, "nan") || has_word(svg, "inf")) return "not a number";
  if (svg.find(" id=") != std::string::npos) return "an id";
  if (svg.find("url(") != std::string::npos) return "a link";
  return "";
}

/// The lowest place that the legend reaches; 0 without a legend.
inline double legend_bottom(const std::string& svg) {
  double bottom = 0.0;
  for (const Element& name : elements(svg, "lw-legend-name")) {
    bottom = std::max(bottom, name.number("y") + 4.0);
  }
  return bottom;
}

/// The highest place of the grid, which is the top of the plot.
inline double plot_top(const std::string& svg) {
  double top = 1e9;
  for (const Element& line : elements(svg, "lw-grid")) {
    const std::vector<double> path = numbers(line.attributes.at("d"));
    for (std::size_t i = 1; i < path.size(); i += 2) top = std::min(top, path[i]);
  }
  return top;
}

}  // namespace linewright::test
