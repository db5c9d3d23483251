#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "linewright/evaluation/gantt.hpp"

namespace linewright::gantt {

inline constexpr const char* kZonesHeading = "Zones";

/// Appends intervals to one row so that they stay in order, within the run and without overlaps.
class RowBuilder {
 public:
  RowBuilder(GanttRow& row, Tick last, std::size_t& budget)
      : row_(row), last_(last), budget_(budget) {}

  /// Adds what is left of the interval once cut to the free part of the run; nothing: dropped.
  /// `interval.text` gets the ticks appended. Throws ScenarioError when the budget is used up.
  void add(GanttInterval interval, const std::string& after_ticks = {});

  /// Up to where the row is filled.
  [[nodiscard]] Tick filled() const { return filled_; }
  /// From `tick` on the row is free.
  void skip_to(Tick tick) { filled_ = std::max(filled_, std::min(tick, last_)); }

 private:
  GanttRow& row_;
  Tick last_;
  std::size_t& budget_;
  Tick filled_ = 0;
};

/// One row per worker. `budget`: intervals that may still be made.
[[nodiscard]] std::vector<GanttRow> worker_rows(const LogDocument& log, std::size_t& budget);

/// One row per machine.
[[nodiscard]] std::vector<GanttRow> machine_rows(const LogDocument& log, std::size_t& budget);

/// One row per zone that is closed at any time.
[[nodiscard]] std::vector<GanttRow> zone_rows(const LogDocument& log, std::size_t& budget);

/// "load_flange.inner (decision 7)"
[[nodiscard]] std::string decision_title(const LogDocument& log, std::int32_t n);

}  // namespace linewright::gantt
