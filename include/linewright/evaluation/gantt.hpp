#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "linewright/base/tick.hpp"
#include "linewright/evaluation/log_document.hpp"

namespace linewright {

enum class GanttKind : std::uint8_t {
  kTravel,      ///< a worker on its way
  kWork,        ///< a worker moving an item or operating a machine
  kWaiting,     ///< a worker within a task, for others, for material, or settling
  kWorking,     ///< a machine in an operation
  kHeld,        ///< a machine kept between two operations
  kRecovering,  ///< a machine after an operation, before it is free
  kClosed,      ///< a zone that may not be entered
};

/// From the beginning of `begin` to the beginning of `end`; begin < end.
struct GanttInterval {
  Tick begin = 0;
  Tick end = 0;
  GanttKind kind = GanttKind::kWork;
  std::optional<std::size_t> task;  ///< index into GanttChart::tasks; none: a machine by itself
  std::int32_t decision = 0;        ///< 0: none
  std::string label;                ///< for inside the bar: the task or the operation
  std::string text;                 ///< for hovering: who, what, when
  std::string what;                 ///< what of `text`: "walk rack → table", "held after pick"
};

/// One worker or machine; intervals in order of time, without overlaps, within the run.
struct GanttRow {
  std::string name;
  std::vector<GanttInterval> intervals;

  [[nodiscard]] Tick busy_ticks() const;
};

struct GanttSection {
  std::string heading;
  std::vector<GanttRow> rows;
};

struct GanttTask {
  std::int32_t number = 0;
  std::string name;
};

struct GanttDecision {
  Tick tick = 0;
  std::int32_t n = 0;
  std::size_t task = 0;
  std::string text;
};

struct GanttMilestone {
  Tick tick = 0;
  std::string name;
};

/// A moment that somebody points out, such as (a) in a text about the run.
struct GanttMark {
  Tick tick = 0;
  std::string label;
};

/// Who did what, when, ready to be drawn. All text is as in the log, not yet escaped for any
/// format.
struct GanttChart {
  std::string title;               ///< name of the line
  std::vector<std::string> facts;  ///< crew, order, outcome, number of decisions
  double tick_s = 1.0;
  Tick last = 1;  ///< the run is 0 ... last
  bool finished = false;
  std::string ending;  ///< for the line at the end: "finished 745", "deadlock 313"; empty: no line
  std::vector<GanttTask> tasks;
  std::vector<GanttSection> sections;  ///< people, robots and others by kind, then machines
  std::vector<GanttDecision> decisions;
  std::vector<GanttMilestone> milestones;
  std::vector<GanttMark> marks;  ///< none: no row for them
};

/// Most intervals a chart may have; more cannot be looked at.
inline constexpr std::size_t kMostGanttIntervals = 100'000;

/// Lays the run out as a chart. In a line with dozens of machines, those that never work are left
/// out. Throws ScenarioError for a run of more than kMostGanttIntervals.
[[nodiscard]] GanttChart make_gantt(const LogDocument& log);

/// One SVG without scripts, fonts or links; details on hover, light or dark as the viewer prefers.
[[nodiscard]] std::string gantt_svg(const GanttChart& chart);

/// One HTML page that needs nothing else: zoom and pan along time, details on hover or by keyboard,
/// and tasks highlighted from the legend. Nothing that stands in the log is executed.
[[nodiscard]] std::string gantt_html(const GanttChart& chart);

/// Writes the chart to `path`, as SVG or HTML by its extension, creating its folder; a reader never
/// sees half a file. Throws ScenarioError for another extension or when it cannot be written.
void write_gantt(const GanttChart& chart, const std::string& path);

}  // namespace linewright
