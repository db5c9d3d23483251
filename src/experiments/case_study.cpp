#include "linewright/experiments/case_study.hpp"

#include <fmt/format.h>

#include <cctype>
#include <memory>
#include <set>
#include <sstream>

#include "linewright/allocation/allocator.hpp"
#include "linewright/base/diagnostic.hpp"
#include "linewright/evaluation/event_log_writer.hpp"
#include "linewright/evaluation/gantt.hpp"
#include "linewright/evaluation/hall_picture.hpp"
#include "linewright/evaluation/recorded_run.hpp"
#include "linewright/evaluation/routes_svg.hpp"
#include "linewright/planning/episode.hpp"
#include "linewright/planning/replay.hpp"

namespace linewright {
namespace {

StationId station_of(const CaseStudy& study, const LineModel& line, const std::string& name) {
  std::vector<std::string> names;
  for (std::size_t s = 0; s < line.stations.size(); ++s) {
    if (line.stations[s].name == name) return StationId{static_cast<std::int32_t>(s)};
    names.push_back(line.stations[s].name);
  }
  throw ScenarioError(study.name + ".yaml", fmt::format("there is no station {}", in_quotes(name)),
                      name_hint(name, names));
}

/// By kind, as RunSetup has them.
template <class Kinds>
std::vector<std::vector<StationId>> starts_of(const CaseStudy& study, const LineModel& line,
                                              const Kinds& kinds, std::set<std::string>& used) {
  std::vector<std::vector<StationId>> starts;
  for (const auto& kind : kinds) {
    auto& stations = starts.emplace_back();
    const auto found = study.starts.find(kind.name);
    if (found == study.starts.end()) continue;
    used.insert(kind.name);
    for (const std::string& name : found->second) {
      stations.push_back(station_of(study, line, name));
    }
  }
  return starts;
}

void check_crew(const CaseStudy& study, const LineModel& line, const RunSetup& setup) {
  for (std::size_t k = 0; k < line.worker_kinds.size(); ++k) {
    const WorkerKind& kind = line.worker_kinds[k];
    const auto count = static_cast<std::int32_t>(setup.worker_start[k].size());
    if (count >= kind.count.min && count <= kind.count.max) continue;
    throw ScenarioError(study.name + ".yaml",
                        fmt::format("{} starts of {}, but the line has {} to {} of them", count,
                                    in_quotes(kind.name), kind.count.min, kind.count.max),
                        "give 'starts' a station for each");
  }
}

RunSetup setup_of(const CaseStudy& study, const LineModel& line) {
  RunSetup setup{.order = study.order, .horizon = line.horizon.ticks(study.order)};
  std::set<std::string> used;
  setup.worker_start = starts_of(study, line, line.worker_kinds, used);
  setup.carrier_start = starts_of(study, line, line.carrier_kinds, used);
  for (const auto& [kind, stations] : study.starts) {
    if (used.count(kind) > 0) continue;
    std::vector<std::string> names;
    for (const auto& worker : line.worker_kinds) names.push_back(worker.name);
    for (const auto& carrier : line.carrier_kinds) names.push_back(carrier.name);
    throw ScenarioError(study.name + ".yaml",
                        fmt::format("the line has no workers or carriers {}", in_quotes(kind)),
                        name_hint(kind, names));
  }
  setup.closures = all_closures(line, {});
  check_crew(study, line, setup);
  check_setup(line, setup);
  return setup;
}

/// Tick of the n-th decision for the task; none: it was not chosen that often.
std::optional<Tick> tick_of(const CaseMark& mark, const LogDocument& log) {
  std::int32_t seen = 0;
  for (const std::size_t at : log.decisions) {
    const auto& decision = std::get<LoggedDecision>(log.events[at].what);
    if (log.header.tasks[decision.task.index()].name != mark.task) continue;
    if (++seen == mark.nth) return log.events[at].tick;
  }
  return std::nullopt;
}

std::string outcome_of(const LogDocument& log) {
  if (log.end.makespan) return fmt::format("finished at tick {}", *log.end.makespan);
  return fmt::format("not finished: {} at tick {}", run_status_name(log.end.status), log.end.tick);
}

ReportFigure chart_of(const CaseStudy& study, const CaseRow& row, const LogDocument& log) {
  GanttChart chart = make_gantt(log);
  chart.title = row.who.name;
  for (const CaseMark& mark : study.marks) {
    if (const auto tick = tick_of(mark, log)) chart.marks.push_back({*tick, mark.mark});
  }
  std::string name = fmt::format("{}_gantt_{}", study.name, row.who.name);
  for (char& c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-' && c != '_') c = '_';
  }
  return {.figure = {.name = std::move(name),
                     .caption = fmt::format("{}: {}.", row.who.name, outcome_of(log)),
                     .svg = gantt_svg(chart),
                     .wide = true},
          .own_style = true};
}

/// Two pictures side by side on a page, each still to be read.
constexpr HallPictureOptions kSmall{.most_width = 660.0, .most_height = 420.0};

/// The hall at the marks of a run.
std::vector<ReportFigure> snapshots_of(const CaseStudy& study, const LogDocument& log) {
  std::vector<ReportFigure> figures;
  for (const CaseMark& mark : study.marks) {
    const auto tick = tick_of(mark, log);
    if (!tick) continue;
    figures.push_back(
        {.figure = {.name = fmt::format("{}_snapshot_{}", study.name, mark.mark),
                    .caption = fmt::format("({}) {}, tick {}: {}", mark.mark,
                                           study.rows.front().who.name, *tick, mark.says),
                    .svg = hall_picture(log, *tick, kSmall)},
         .own_style = true});
  }
  return figures;
}

ReportTable outcomes_of(const CaseStudy& study, const std::vector<LogDocument>& logs) {
  ReportTable table{.caption = "Outcome", .header = {"", "makespan, ticks", "decisions"}};
  for (std::size_t r = 0; r < study.rows.size(); ++r) {
    const LogDocument& log = logs.at(r);
    table.rows.push_back(
        {.cells = {study.rows[r].who.name,
                   log.end.makespan ? std::to_string(*log.end.makespan) : outcome_of(log),
                   std::to_string(log.decisions.size())}});
  }
  return table;
}

ReportTable marks_of(const CaseStudy& study, const std::vector<LogDocument>& logs) {
  ReportTable table{.caption = "The marks: when a task is chosen for the n-th time",
                    .header = {"mark", "task", "n"},
                    .numbers = false};
  for (const CaseRow& row : study.rows) table.header.push_back("tick, " + row.who.name);
  table.header.emplace_back("what there is to see");
  for (const CaseMark& mark : study.marks) {
    auto& out = table.rows.emplace_back(
        ReportTable::Row{.cells = {mark.mark, mark.task, std::to_string(mark.nth)}});
    for (std::size_t r = 0; r < study.rows.size(); ++r) {
      const auto tick = tick_of(mark, logs.at(r));
      out.cells.push_back(tick ? std::to_string(*tick) : "never");
    }
    out.cells.push_back(mark.says);
  }
  return table;
}

}  // namespace

LogDocument play_case(const CaseStudy& study, const CaseRow& row, const std::string& planner_name,
                      const Scenario& scenario) {
  const Simulator simulator(std::make_shared<const LineModel>(scenario.line));
  const RunSetup setup = setup_of(study, simulator.line());
  const auto allocator = make_allocator(row.who.allocator, simulator);
  EventLog log;
  SimulationState state;
  if (row.decisions.empty()) {
    const PlannerContext context{.allocator = row.who.allocator,
                                 .scenario_file = scenario.file,
                                 .scenario_hash = scenario.content_hash};
    const auto planner = PlannerRegistry::make(planner_name, simulator, context);
    run_episode(simulator, state, setup, row.seed, *planner, *allocator, {.log = &log});
  } else {
    const RecordedRun recorded = load_recorded_run(row.decisions, simulator.line());
    const auto fallback = make_allocator("first_idle", simulator);
    replay(simulator, state, setup, recorded.decisions, *fallback, &log);
  }
  std::istringstream text(event_log_text(scenario, log, simulator.progress(state)));
  return read_event_log(text, study.name);
}

ReportSection section_of(const CaseStudy& study, const std::vector<LogDocument>& logs) {
  ReportSection section{.title = study.title};
  if (!study.about.empty()) section.paragraphs.push_back(study.about);
  section.tables.push_back(outcomes_of(study, logs));
  if (!study.marks.empty()) section.tables.push_back(marks_of(study, logs));
  for (std::size_t r = 0; r < study.rows.size(); ++r) {
    section.figures.push_back(chart_of(study, study.rows[r], logs.at(r)));
  }
  for (ReportFigure& figure : snapshots_of(study, logs.front())) {
    section.figures.push_back(std::move(figure));
  }
  return section;
}

ReportSection section_of(const RouteShowcase& showcase, const Scenario& scenario) {
  const std::vector<RoutesPanel> panels =
      scenario.map ? showcase_panels(scenario) : std::vector<RoutesPanel>{};
  if (panels.empty()) {
    throw ScenarioError(showcase.scenario, "no worker's ways come from a map",
                        "name a scenario with a map and travel: {KIND: hybrid_a_star}");
  }
  ReportSection section{.title = showcase.title};
  if (!showcase.about.empty()) section.paragraphs.push_back(showcase.about);
  section.figures.push_back(
      {.figure = {.name = showcase.name,
                  .caption = "Routes from one station to all others: two starts for each kind of "
                             "worker that lie far apart. Dashed: backwards.",
                  .svg = routes_svg(scenario, panels),
                  .wide = true},
       .own_style = true});
  return section;
}

}  // namespace linewright
