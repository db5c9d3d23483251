#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "head.hpp"
#include "linewright/charts/chart.hpp"
#include "plot.hpp"

// Horizontal lines with a label, across a plot.
namespace linewright::charts {

/// The lines of one chart. A label stands at its line, where it hides nothing. Without such a place
/// it goes to the legend, for which the plot must make room: then all is laid out once more.
class References {
 public:
  explicit References(const std::vector<ReferenceLine>& lines)
      : lines_(lines), in_legend_(lines.size(), false) {}

  void add_to(Range& range) const;

  /// Finds the labels' places; `data` must not be hidden. False when the legend has grown.
  [[nodiscard]] bool place(const Plot& plot, const std::vector<Box>& data);

  [[nodiscard]] std::vector<LegendEntry> legend() const;

  [[nodiscard]] std::string draw_lines(const Plot& plot) const;

  /// Of the last call of place(); to be drawn over the data.
  [[nodiscard]] const std::string& labels() const { return labels_; }

 private:
  /// The other lines, near to which a label would seem to be theirs.
  [[nodiscard]] std::vector<Box> others(const Plot& plot, std::size_t of) const;

  std::vector<ReferenceLine> lines_;
  std::vector<bool> in_legend_;
  std::string labels_;
};

}  // namespace linewright::charts
