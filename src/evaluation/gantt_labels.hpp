#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "linewright/evaluation/gantt.hpp"

namespace linewright::gantt {

/// Words to stand over a stretch of a row.
struct BarLabel {
  Tick begin = 0;
  Tick end = 0;
  GanttKind kind = GanttKind::kWork;  ///< of the bar underneath
  std::optional<std::size_t> task;
  std::string words;
};

/// One label per task of a worker, over its longest uninterrupted work (else waiting, else way),
/// and one per operation of a machine.
[[nodiscard]] std::vector<BarLabel> labels_of(const GanttRow& row);

/// What of it fits into `width` pixels: `words`, else `number`, or the beginning of `words` when
/// there is no number; empty: nothing.
[[nodiscard]] std::string fitting(const std::string& words, const std::string& number,
                                  double width);

/// Ticks between grid lines: 1, 2 or 5 times a power of ten, so that labels have room.
[[nodiscard]] Tick grid_step(Tick last, double plot_width);

}  // namespace linewright::gantt
