#include "reproduction_report.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <ctime>

#include "common.hpp"
#include "linewright/base/files.hpp"
#include "linewright/experiments/figures.hpp"
#include "linewright/experiments/render.hpp"
#include "linewright/experiments/report.hpp"
#include "linewright_commit.hpp"
#include "machine_facts.hpp"

namespace linewright::cli {
namespace {

std::string command_of(const ReproduceArguments& arguments) {
  std::string command = "linewright reproduce " + arguments.what;
  if (arguments.quick) command += " --quick";
  if (!arguments.policies.empty()) command += " --policies " + arguments.policies;
  return command;
}

std::string seeds_of(const std::vector<Experiment>& experiments) {
  std::vector<std::uint64_t> seeds;
  for (const Experiment& experiment : experiments) {
    seeds.insert(seeds.end(), experiment.seeds.begin(), experiment.seeds.end());
  }
  std::sort(seeds.begin(), seeds.end());
  seeds.erase(std::unique(seeds.begin(), seeds.end()), seeds.end());
  return fmt::format("{}", fmt::join(seeds, ", "));
}

std::string policies_of(const ReproduceArguments& arguments) {
  return arguments.policies.empty()
             ? "trained by this command, " + arguments.out + "/train"
             : "trained before, " + arguments.policies + " (each file says how)";
}

bool any_trained(const std::vector<Experiment>& experiments) {
  for (const Experiment& experiment : experiments) {
    for (const ExperimentRow& row : experiment.rows) {
      if (!row.algorithm.empty()) return true;
    }
  }
  return false;
}

std::vector<std::pair<std::string, std::string>> facts_of(const Reproduction& reproduction,
                                                          const ReproduceArguments& arguments,
                                                          double wall_s) {
  std::vector<std::pair<std::string, std::string>> facts{
      {"Command", command_of(arguments)},
      {"Program", "linewright " LINEWRIGHT_VERSION ", commit " LINEWRIGHT_COMMIT},
      {"Written", fmt::format("{:%Y-%m-%d %H:%M} UTC", fmt::gmtime(std::time(nullptr)))}};
  if (any_trained(reproduction.experiments())) {
    facts.emplace_back("Policies", policies_of(arguments));
    facts.emplace_back("Training seeds", seeds_of(reproduction.experiments()));
  }
  facts.emplace_back("Cells of the tables",
                     fmt::format("{}, played in {:.0f} s of wall clock (this run and earlier ones)",
                                 reproduction.cells(), reproduction.played_s()));
  facts.emplace_back("This run",
                     fmt::format("{:.0f} s of wall clock, without what was there already", wall_s));
  facts.emplace_back("Machine", machine_facts());
  return facts;
}

/// How the claims of all experiments came out.
std::string summary_of(const std::vector<ExperimentResult>& results) {
  std::size_t holds = 0;
  std::size_t contrary = 0;
  std::size_t open = 0;
  for (const ExperimentResult& result : results) {
    for (const JudgedClaim& claim : result.claims) {
      holds += claim.verdict == JudgedClaim::Verdict::kHolds ? 1 : 0;
      contrary += claim.verdict == JudgedClaim::Verdict::kContrary ? 1 : 0;
      open += claim.verdict == JudgedClaim::Verdict::kOpen ? 1 : 0;
    }
  }
  if (holds + contrary + open == 0) return {};
  return fmt::format(
      "Of {} claims {} hold, {} came out contrary, and {} are open: the 95 % interval of their "
      "difference holds zero, or there is none. Every claim says what its interval is over: one "
      "over training seeds covers other runs of the same training; one over starts (a planner that "
      "is not trained, or one training seed only) says nothing about other seeds.",
      holds + contrary + open, holds, contrary, open);
}

class Writer {
 public:
  Writer(Reproduction& reproduction, const ReproduceArguments& arguments)
      : reproduction_(reproduction),
        arguments_(arguments),
        styles_(styles_of(reproduction.experiments())) {}

  std::string write(double wall_s) {
    const auto& experiments = reproduction_.experiments();
    for (std::size_t e = 0; e < experiments.size(); ++e) {
      results_.push_back(reproduction_.result_of(e));
      write_tables(results_.back());
      report_.sections.push_back(section_of(results_.back(), figures_of(results_.back())));
    }
    const Improvements improvements = improvements_of(results_);
    if (!improvements.axes.empty()) {
      report_.sections.push_back(section_of(improvements, styles_));
    }
    for (const RouteShowcase& showcase : reproduction_.showcases()) {
      report_.sections.push_back(section_of(showcase, reproduction_.scenario(showcase.scenario)));
    }
    for (const CaseStudy& study : reproduction_.case_studies()) {
      report_.sections.push_back(case_section(study));
    }
    write_figures();
    report_.title = "Linewright: " + title();
    report_.summary = summary_of(results_);
    report_.facts = facts_of(reproduction_, arguments_, wall_s);
    write_file(arguments_.out + "/report.html", report_html(report_));
    return markdown_;
  }

 private:
  [[nodiscard]] std::string title() const {
    if (arguments_.what == "paper") return "the paper, reproduced";
    return reproduction_.experiments().size() == 1 ? reproduction_.experiments()[0].title
                                                   : arguments_.what;
  }

  void write_tables(const ExperimentResult& result) {
    const std::string file = arguments_.out + "/tables/" + result.experiment.name;
    const std::string text = result_markdown(result);
    write_file(file + ".csv", result_csv(result));
    write_file(file + ".tex", result_latex(result));
    write_file(file + ".json", result_json(result));
    write_file(file + ".md", text);
    markdown_ += text;
  }

  std::vector<Figure> figures_of(const ExperimentResult& result) {
    const Experiment& experiment = result.experiment;
    if (experiment.columns != Experiment::Columns::kTraining) {
      return table_figures(result, styles_);
    }
    const auto records = reproduction_.records_of(experiment);
    if (std::all_of(records.begin(), records.end(),
                    [](const auto& seeds) { return seeds.empty(); })) {
      report(fmt::format("{}: no training run left a record of itself", experiment.name));
    }
    return training_figures(experiment, records, styles_);
  }

  ReportSection case_section(const CaseStudy& study) {
    std::vector<LogDocument> logs;
    for (const CaseRow& row : study.rows) {
      const std::string planner =
          row.who.algorithm.empty()
              ? row.who.planner
              : "policy:" + reproduction_.policy_of(study.trained_on, row.who, row.seed);
      logs.push_back(play_case(study, row, planner, reproduction_.scenario(study.scenario)));
    }
    return section_of(study, logs);
  }

  void write_figures() const {
    for (const ReportSection& section : report_.sections) {
      for (const ReportFigure& figure : section.figures) {
        write_file(fmt::format("{}/figures/{}.svg", arguments_.out, figure.figure.name),
                   figure.figure.svg);
      }
    }
  }

  Reproduction& reproduction_;
  const ReproduceArguments& arguments_;
  RowStyles styles_;
  std::vector<ExperimentResult> results_;
  Report report_;
  std::string markdown_;
};

}  // namespace

std::string write_results(Reproduction& reproduction, const ReproduceArguments& arguments,
                          double wall_s) {
  return Writer(reproduction, arguments).write(wall_s);
}

}  // namespace linewright::cli
