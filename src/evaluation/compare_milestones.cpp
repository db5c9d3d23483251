#include <algorithm>
#include <map>
#include <utility>

#include "linewright/evaluation/recorded_run.hpp"

namespace linewright {
namespace {

/// Ticks of the log's events that a recorded (name, label) stands for, in order of time.
std::vector<Tick> ticks_of(const RecordedMilestone& wanted, const LineModel& line,
                           const EventLog& log) {
  const std::string full = wanted.label.empty() ? wanted.name : wanted.name + "." + wanted.label;
  const bool defined = std::any_of(line.milestones.begin(), line.milestones.end(),
                                   [&](const Milestone& m) { return m.name == full; });
  std::vector<Tick> ticks;
  for (const LogEvent& event : log.events) {
    const auto id = static_cast<std::size_t>(event.a);
    bool match = false;
    if (event.type == LogEvent::Type::kMilestone) {
      const std::string& name = line.milestones[id].name;
      match = name == full || (wanted.label.empty() && name.starts_with(wanted.name + ".")) ||
              (!defined && name == wanted.name);
    } else if (!defined && event.type == LogEvent::Type::kDecision) {
      match = wanted.name == "task_start" && line.tasks[id].name == wanted.label;
    } else if (!defined && event.type == LogEvent::Type::kTaskEnd) {
      match = wanted.name == "task_end" && line.tasks[id].name == wanted.label;
    }
    if (match) ticks.push_back(event.tick);
  }
  return ticks;
}

}  // namespace

std::vector<MilestoneComparison> compare_milestones(const RecordedRun& run, const LineModel& line,
                                                    const EventLog& log) {
  std::vector<MilestoneComparison> comparisons;
  std::map<std::pair<std::string, std::string>, std::pair<std::vector<Tick>, std::size_t>> ours;
  for (const RecordedMilestone& recorded : run.milestones) {
    const auto [entry, is_new] = ours.try_emplace({recorded.name, recorded.label});
    auto& [ticks, next] = entry->second;
    if (is_new) ticks = ticks_of(recorded, line, log);
    MilestoneComparison& comparison = comparisons.emplace_back();
    comparison.recorded = recorded;
    if (next < ticks.size()) comparison.ours = ticks[next++];
  }
  return comparisons;
}

}  // namespace linewright
