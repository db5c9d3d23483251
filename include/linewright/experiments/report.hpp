#pragma once

#include <string>
#include <utility>
#include <vector>

#include "linewright/experiments/figures.hpp"
#include "linewright/experiments/table.hpp"

// One HTML page about several experiments, which needs nothing else: no scripts, fonts or links to
// elsewhere; light or dark as the viewer prefers, light on paper. All text comes unescaped and is
// never executed.
namespace linewright {

/// A table of texts.
struct ReportTable {
  struct Row {
    std::vector<std::string> cells;  ///< the first one is the row's name
    bool secondary = false;          ///< belongs to the row above, such as the paper's figures
  };
  std::string caption;
  std::vector<std::string> header;
  std::vector<Row> rows;
  bool numbers = true;  ///< cells behind the first are numbers: to the right
};

/// A picture in the page. SVGs with a style of their own are kept apart from the page, so that
/// neither changes the other.
struct ReportFigure {
  Figure figure;
  bool own_style = false;
};

struct ReportSection {
  std::string title;
  std::vector<std::string> paragraphs;
  std::vector<ReportTable> tables;
  std::vector<ReportFigure> figures;
};

struct Report {
  std::string title;
  std::string summary;
  /// How it was made: the command, the commit, the machine, ..., in this order.
  std::vector<std::pair<std::string, std::string>> facts;
  std::vector<ReportSection> sections;
};

/// The page. The same report gives the same bytes.
[[nodiscard]] std::string report_html(const Report& report);

/// What was run, a table per metric with the paper's figures below ours, and the claims with their
/// verdicts. `figures`: of this experiment.
[[nodiscard]] ReportSection section_of(const ExperimentResult& result, std::vector<Figure> figures);

/// The improvements over their base, as a table and a picture.
[[nodiscard]] ReportSection section_of(const Improvements& improvements, const RowStyles& styles);

}  // namespace linewright
