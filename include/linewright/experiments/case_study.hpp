#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "linewright/evaluation/log_document.hpp"
#include "linewright/experiments/experiment.hpp"
#include "linewright/experiments/report.hpp"
#include "linewright/scenario/scenario.hpp"
#include "linewright/simulation/run_setup.hpp"

namespace linewright {

/// A moment of a run: when a task is chosen for the n-th time.
struct CaseMark {
  std::string mark;  ///< "a"
  std::string task;
  std::int32_t nth = 1;
  std::string says;  ///< what there is to see
};

/// Who decides in a case study.
struct CaseRow {
  ExperimentRow who;       ///< an algorithm or a planner; or empty and
  std::string decisions;   ///< ... a file of recorded decisions, which are replayed
  std::uint64_t seed = 1;  ///< of training
};

/// One run from one start, looked at closely: a Gantt chart for each row, and pictures of the hall
/// at the marks of the first one. Files: docs/formats/experiment.md.
struct CaseStudy {
  std::string name;  ///< the file's, without its folder and ending
  std::string title;
  std::string about;
  std::string scenario;    ///< file
  std::string trained_on;  ///< the scenario's file on which algorithms are trained
  std::int32_t order = 1;
  /// Stations, by kind of worker or carrier: who is there and where each one starts.
  std::map<std::string, std::vector<std::string>> starts;
  std::vector<CaseRow> rows;
  std::vector<CaseMark> marks;
};

/// The routes of a scenario, as in the paper's showcase.
struct RouteShowcase {
  std::string name;
  std::string title;
  std::string about;
  std::string scenario;  ///< file; its workers' ways come from a map
};

/// What a file of experiments is: its key `kind`, "case_study" or "routes"; empty: an experiment
/// (or a file that cannot be read: load_experiment() says why).
[[nodiscard]] std::string kind_of_study(const std::string& file);

/// Throws ScenarioError with everything that is wrong, where it stands, and the nearest known key.
[[nodiscard]] CaseStudy load_case_study(const std::string& file);
[[nodiscard]] RouteShowcase load_route_showcase(const std::string& file);

/// Plays one row of it: `planner` (PlannerRegistry), or its recorded decisions where it has some.
/// Throws ScenarioError when stations, workers or tasks are not those of the scenario, or the
/// planner does not fit.
[[nodiscard]] LogDocument play_case(const CaseStudy& study, const CaseRow& row,
                                    const std::string& planner, const Scenario& scenario);

/// The charts of all rows (`logs`, in the order of the rows), the hall at the marks of the first, a
/// table of its marks. A mark whose task was not chosen that often is left out of the charts and
/// said to be missing in the table.
[[nodiscard]] ReportSection section_of(const CaseStudy& study,
                                       const std::vector<LogDocument>& logs);

/// The picture of routes_svg(). Throws ScenarioError when nothing in the scenario is routed.
[[nodiscard]] ReportSection section_of(const RouteShowcase& showcase, const Scenario& scenario);

}  // namespace linewright
