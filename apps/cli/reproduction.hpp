#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "linewright/experiments/case_study.hpp"
#include "linewright/experiments/cell.hpp"
#include "linewright/experiments/experiment.hpp"
#include "linewright/experiments/paper.hpp"
#include "linewright/experiments/table.hpp"
#include "linewright/experiments/training_record.hpp"
#include "linewright/scenario/scenario.hpp"
#include "train_jobs.hpp"

// What `reproduce` does before it writes anything.
namespace linewright::cli {

struct ReproduceArguments {
  std::string what;
  bool quick = false;
  std::string out = "out/reproduce";
  std::string policies;  ///< folder; empty: everything is trained
};

/// Several experiments together: training runs and cells that they share are made once, and those
/// that are there already are taken as they are.
class Reproduction {
 public:
  /// Reads all experiments. Throws ScenarioError for files that do not exist or are wrong.
  explicit Reproduction(const ReproduceArguments& arguments);

  /// Trains what is missing. False: interrupted.
  bool train();
  /// Plays what is missing. False: interrupted.
  bool play();

  [[nodiscard]] const std::vector<Experiment>& experiments() const { return experiments_; }
  [[nodiscard]] const std::vector<CaseStudy>& case_studies() const { return case_studies_; }

  [[nodiscard]] const std::vector<RouteShowcase>& showcases() const { return showcases_; }

  /// Of one of experiments(), after play().
  [[nodiscard]] ExperimentResult result_of(std::size_t experiment) const;
  /// By row and seed: what the training runs wrote about themselves, where it was kept.
  [[nodiscard]] std::vector<std::vector<TrainingRecord>> records_of(
      const Experiment& experiment) const;
  /// What the paper prints beside the experiment's rows; none: its folder has no such tables.
  [[nodiscard]] const PaperTables* paper_of(const Experiment& experiment) const;

  [[nodiscard]] const Scenario& scenario(const std::string& file);
  /// Where the policy of a trained row is.
  [[nodiscard]] std::string policy_of(const std::string& trained_on, const ExperimentRow& row,
                                      std::uint64_t seed) const;

  /// How many cells there are, and seconds that playing them took, in earlier runs or this one.
  [[nodiscard]] std::size_t cells() const { return results_.size(); }
  [[nodiscard]] double played_s() const;

 private:
  /// One row, seed and order of an experiment.
  struct Planned {
    ExperimentCell cell;
    std::string scenario;
    std::string key;
  };

  [[nodiscard]] TrainJob job_of(const std::string& trained_on, const ExperimentRow& row,
                                std::uint64_t seed) const;
  [[nodiscard]] bool is_given(const ExperimentRow& row) const;
  void want(const std::string& trained_on, const ExperimentRow& row, std::uint64_t seed,
            std::map<std::string, TrainJob>& jobs) const;
  void plan();
  [[nodiscard]] std::vector<Planned> cells_of(const Experiment& experiment,
                                              const ExperimentRow& row);
  [[nodiscard]] std::size_t runs_of(const Planned& planned);

  const ReproduceArguments& arguments_;
  CellStore store_;
  std::vector<Experiment> experiments_;
  std::vector<CaseStudy> case_studies_;
  std::vector<RouteShowcase> showcases_;
  std::map<std::string, PaperTables> papers_;  ///< by file
  std::map<std::string, Scenario> scenarios_;
  std::vector<std::vector<std::vector<Planned>>> cells_;  ///< by experiment and row
  std::vector<Planned> left_;                             ///< to be played
  std::map<std::string, CellResult> results_;             ///< by key
};

}  // namespace linewright::cli
