#include "linewright/evaluation/gantt.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iterator>
#include <utility>

#include "gantt_rows.hpp"
#include "linewright/base/diagnostic.hpp"
#include "linewright/evaluation/event_log_writer.hpp"

namespace linewright {
namespace gantt {

void RowBuilder::add(GanttInterval interval, const std::string& after_ticks) {
  interval.begin = std::max(interval.begin, filled_);
  interval.end = std::min(interval.end, last_);
  if (interval.begin >= interval.end) return;
  if (budget_ == 0) {
    throw ScenarioError(
        "",
        fmt::format("the run has more than {} intervals: too many to draw", kMostGanttIntervals),
        "draw a shorter run");
  }
  --budget_;
  filled_ = interval.end;
  interval.text += fmt::format(" · ticks {}–{}{}", interval.begin, interval.end, after_ticks);
  row_.intervals.push_back(std::move(interval));
}

std::string decision_title(const LogDocument& log, std::int32_t n) {
  return fmt::format("{} (decision {})", log.header.tasks[log.decision(n).task.index()].name, n);
}

}  // namespace gantt

namespace {

constexpr std::size_t kManyMachines = 24;  ///< above: those that never work are left out

/// Workers' rows by kind, in the order in which the kinds appear.
std::vector<GanttSection> by_kind(const LogDocument& log, std::vector<GanttRow> rows) {
  std::vector<GanttSection> sections;
  std::vector<std::string> kinds;
  for (std::size_t w = 0; w < rows.size(); ++w) {
    const std::string& kind = log.header.workers[w].kind;
    const auto found = std::find(kinds.begin(), kinds.end(), kind);
    const auto at = static_cast<std::size_t>(found - kinds.begin());
    if (found == kinds.end()) {
      kinds.push_back(kind);
      sections.push_back({kind == "human" ? "People" : kind == "robot" ? "Robots" : kind, {}});
    }
    sections[at].rows.push_back(std::move(rows[w]));
  }
  // People first, then robots, then the others as the header lists them.
  const auto rank = [](const GanttSection& section) {
    return section.heading == "People" ? 0 : section.heading == "Robots" ? 1 : 2;
  };
  std::stable_sort(sections.begin(), sections.end(),
                   [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
  return sections;
}

void add_machines(std::vector<GanttRow> rows, std::vector<GanttSection>& sections) {
  if (rows.size() > kManyMachines) {
    std::erase_if(rows, [](const GanttRow& row) { return row.intervals.empty(); });
  }
  if (!rows.empty()) sections.push_back({"Machines", std::move(rows)});
}

std::string crew_text(const LogHeader& header) {
  std::vector<std::pair<std::string, int>> counts;
  const auto count = [&](const std::string& kind) {
    const auto same = [&](const auto& entry) { return entry.first == kind; };
    const auto found = std::find_if(counts.begin(), counts.end(), same);
    if (found == counts.end()) {
      counts.emplace_back(kind, 1);
    } else {
      ++found->second;
    }
  };
  for (const LogWorker& worker : header.workers) count(worker.kind);
  for (const LogCarrier& carrier : header.carriers) count(carrier.kind);
  std::string text;
  for (const auto& [kind, number] : counts) {
    text +=
        fmt::format("{}{} {}{}", text.empty() ? "" : ", ", number, kind, number == 1 ? "" : "s");
  }
  return text.empty() ? "nobody" : text;
}

std::string duration(double seconds) {
  if (seconds < 60.0) return fmt::format("{:.3g} s", seconds);
  const double whole = std::round(seconds);
  if (whole < 3600.0)
    return fmt::format("{:.0f} min {:.0f} s", std::floor(whole / 60), std::fmod(whole, 60));
  return fmt::format("{:.0f} h {:.0f} min", std::floor(whole / 3600),
                     std::floor(std::fmod(whole, 3600) / 60));
}

std::string outcome(const LogDocument& log) {
  const LoggedEnd& end = log.end;
  const double percent = 100.0 * end.progress;
  switch (end.status) {
    case RunStatus::kFinished:
      return fmt::format("finished after {} ticks ({})", end.makespan.value_or(end.tick),
                         duration(end.makespan.value_or(end.tick) * log.header.tick_s));
    case RunStatus::kDeadlock:
      return fmt::format("deadlock at tick {}, {:.0f} % of the order done", end.tick, percent);
    case RunStatus::kRunning:
      return fmt::format("the log breaks off at tick {}", end.tick);
    default:
      return fmt::format("not finished within {} ticks, {:.0f} % of the order done", end.tick,
                         percent);
  }
}

std::string ending(const LoggedEnd& end) {
  const char* status = end.status == RunStatus::kFinished   ? "finished"
                       : end.status == RunStatus::kDeadlock ? "deadlock"
                       : end.status == RunStatus::kRunning  ? "cut off"
                                                            : "horizon";
  return fmt::format("{} {}", status, end.tick);
}

std::string members(const LogDocument& log, const LoggedDecision& decision) {
  std::string text;
  for (const LoggedRole& role : decision.crew) {
    for (const WorkerId worker : role.workers)
      text += " · " + log.header.workers[worker.index()].id;
    for (const CarrierId carrier : role.carriers) {
      text += " · " + log.header.carriers[carrier.index()].id;
    }
  }
  return text;
}

void add_marks(const LogDocument& log, GanttChart& chart) {
  for (const LoggedEvent& event : log.events) {
    const Tick tick = std::min(event.tick, chart.last);
    if (const auto* decision = std::get_if<LoggedDecision>(&event.what)) {
      const GanttTask& task = chart.tasks[decision->task.index()];
      chart.decisions.push_back({tick, decision->n, decision->task.index(),
                                 fmt::format("decision {} · tick {} · {}{}", decision->n,
                                             event.tick, task.name, members(log, *decision))});
    } else if (const auto* milestone = std::get_if<LoggedMilestone>(&event.what)) {
      chart.milestones.push_back({tick, milestone->name});
    }
  }
}

}  // namespace

Tick GanttRow::busy_ticks() const {
  Tick sum = 0;
  for (const GanttInterval& interval : intervals) sum += interval.end - interval.begin;
  return sum;
}

GanttChart make_gantt(const LogDocument& log) {
  GanttChart chart;
  chart.title = log.header.line;
  chart.tick_s = log.header.tick_s;
  chart.last = std::max<Tick>(1, log.end.tick);
  chart.finished = log.end.status == RunStatus::kFinished;
  chart.ending = ending(log.end);
  for (const LogTask& task : log.header.tasks) chart.tasks.push_back({task.number, task.name});
  chart.facts = {crew_text(log.header),
                 fmt::format("order: {} × {}", log.header.quantity, log.header.product),
                 outcome(log), fmt::format("{} decisions", log.decisions.size())};
  std::size_t budget = kMostGanttIntervals;
  chart.sections = by_kind(log, gantt::worker_rows(log, budget));
  add_machines(gantt::machine_rows(log, budget), chart.sections);
  std::vector<GanttRow> zones = gantt::zone_rows(log, budget);
  if (!zones.empty()) chart.sections.push_back({gantt::kZonesHeading, std::move(zones)});
  add_marks(log, chart);
  return chart;
}

}  // namespace linewright
