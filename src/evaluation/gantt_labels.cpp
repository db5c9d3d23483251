#include "gantt_labels.hpp"

#include <string_view>

#include "linewright/base/markup.hpp"

namespace linewright::gantt {
namespace {

constexpr double kLabelSize = 10.0;
constexpr double kShortestStub = 42.0;  ///< pixels; less of a name tells nothing

/// The better a stretch, the sooner it carries the label.
int rank(GanttKind kind) {
  switch (kind) {
    case GanttKind::kWork:
      return 2;
    case GanttKind::kWaiting:
      return 1;
    default:
      return 0;
  }
}

bool better(const BarLabel& a, const BarLabel& b) {
  if (rank(a.kind) != rank(b.kind)) return rank(a.kind) > rank(b.kind);
  return a.end - a.begin > b.end - b.begin;
}

bool by_worker(GanttKind kind) {
  return kind == GanttKind::kTravel || kind == GanttKind::kWork || kind == GanttKind::kWaiting;
}

/// Joins intervals of one kind that follow one another without a gap, within one task.
std::vector<BarLabel> stretches_of(const std::vector<GanttInterval>& intervals, std::size_t first,
                                   std::size_t end) {
  std::vector<BarLabel> stretches;
  for (std::size_t i = first; i < end; ++i) {
    const GanttInterval& interval = intervals[i];
    if (!stretches.empty() && stretches.back().kind == interval.kind &&
        stretches.back().end == interval.begin) {
      stretches.back().end = interval.end;
    } else {
      stretches.push_back(
          {interval.begin, interval.end, interval.kind, interval.task, interval.label});
    }
  }
  return stretches;
}

/// The part behind the first dot, with the dot: `.inner` of `welder.inner`.
std::string_view instance_of(std::string_view name) {
  const std::size_t dot = name.find('.');
  return dot == std::string_view::npos ? std::string_view() : name.substr(dot);
}

/// An operation of `welder.inner` need not say `.inner` again.
std::string operation_label(const std::string& operation, const std::string& machine) {
  const std::string_view instance = instance_of(machine);
  if (instance.empty() || !operation.ends_with(instance)) return operation;
  return operation.substr(0, operation.size() - instance.size());
}

}  // namespace

std::vector<BarLabel> labels_of(const GanttRow& row) {
  std::vector<BarLabel> labels;
  const auto& intervals = row.intervals;
  for (std::size_t i = 0; i < intervals.size();) {
    const GanttInterval& first = intervals[i];
    if (!by_worker(first.kind)) {
      if (first.kind == GanttKind::kWorking) {
        labels.push_back({first.begin, first.end, first.kind, first.task,
                          operation_label(first.label, row.name)});
      } else if (first.kind == GanttKind::kClosed) {
        labels.push_back({first.begin, first.end, first.kind, first.task, first.label});
      }
      ++i;
      continue;
    }
    std::size_t end = i;
    while (end < intervals.size() && intervals[end].decision == first.decision) ++end;
    const auto stretches = stretches_of(intervals, i, end);
    const BarLabel* best = &stretches.front();
    for (const BarLabel& stretch : stretches) {
      if (better(stretch, *best)) best = &stretch;
    }
    labels.push_back(*best);
    i = end;
  }
  return labels;
}

std::string fitting(const std::string& words, const std::string& number, double width) {
  const double room = width - 4.0;
  if (markup::text_width(words, kLabelSize) <= room) return words;
  if (!number.empty()) return markup::text_width(number, kLabelSize) <= room + 2.0 ? number : "";
  return room < kShortestStub ? "" : markup::shortened(words, room, kLabelSize);
}

Tick grid_step(Tick last, double plot_width) {
  constexpr double kNarrowest = 58.0;  // pixels between two labels
  const auto fits = [&](std::int64_t step) {
    return plot_width * static_cast<double>(step) / static_cast<double>(last) >= kNarrowest;
  };
  std::int64_t power = 1;
  while (true) {
    for (const std::int64_t factor : {1, 2, 5}) {
      if (fits(factor * power) || factor * power >= last) return static_cast<Tick>(factor * power);
    }
    power *= 10;
  }
}

}  // namespace linewright::gantt
