#include "reproduction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <thread>

#include "common.hpp"
#include "experiment_files.hpp"
#include "linewright/base/diagnostic.hpp"
#include "linewright/base/hash.hpp"

namespace linewright::cli {
namespace {

namespace fs = std::filesystem;

/// A folder's name that tells options apart: themselves, where they can stand in a file's name.
std::string folder_of(const std::vector<std::string>& set) {
  std::string name = fmt::format("{}", fmt::join(set, "+"));
  const std::string written = name;
  for (char& c : name) {
    const bool plain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    if (!plain && std::string_view(".=_+-").find(c) == std::string_view::npos) c = '_';
  }
  return name == written ? name : fmt::format("{}-{:08x}", name, hash_of(written) & 0xffffffffU);
}

}  // namespace

Reproduction::Reproduction(const ReproduceArguments& arguments)
    : arguments_(arguments), store_(arguments.out + "/results") {
  for (const std::string& file : experiment_files(arguments.what)) {
    const std::string kind = kind_of_study(file);
    if (kind == "case_study") case_studies_.push_back(load_case_study(file));
    if (kind == "routes") showcases_.push_back(load_route_showcase(file));
    if (kind == "case_study" || kind == "routes") continue;
    experiments_.push_back(load_experiment(file, arguments.quick));
    const Experiment& experiment = experiments_.back();
    static_cast<void>(scenario(experiment.scenario));
    if (experiment.paper.empty() && !fs::exists(experiment.paper_tables)) continue;
    if (papers_.count(experiment.paper_tables) > 0) continue;
    papers_.emplace(experiment.paper_tables, load_paper_tables(experiment.paper_tables));
  }
  for (const CaseStudy& study : case_studies_) static_cast<void>(scenario(study.scenario));
  for (const RouteShowcase& showcase : showcases_) static_cast<void>(scenario(showcase.scenario));
}

const Scenario& Reproduction::scenario(const std::string& file) {
  const auto found = scenarios_.find(file);
  if (found != scenarios_.end()) return found->second;
  return scenarios_.emplace(file, load(file)).first->second;
}

const PaperTables* Reproduction::paper_of(const Experiment& experiment) const {
  const auto found = papers_.find(experiment.paper_tables);
  return found == papers_.end() ? nullptr : &found->second;
}

/// Rows with options of their own are not among trained policies that somebody gives.
bool Reproduction::is_given(const ExperimentRow& row) const {
  return !arguments_.policies.empty() && row.set.empty();
}

TrainJob Reproduction::job_of(const std::string& trained_on, const ExperimentRow& row,
                              std::uint64_t seed) const {
  std::string out = arguments_.out + "/train/" + fs::path(trained_on).stem().string();
  if (!row.set.empty()) out += "/" + folder_of(row.set);
  return {row.algorithm, trained_on, seed, std::move(out), row.set};
}

std::string Reproduction::policy_of(const std::string& trained_on, const ExperimentRow& row,
                                    std::uint64_t seed) const {
  if (!is_given(row)) return job_of(trained_on, row, seed).policy();
  return fmt::format("{}/{}/{}.safetensors", arguments_.policies,
                     fs::path(row.algorithm).stem().string(), seed);
}

void Reproduction::want(const std::string& trained_on, const ExperimentRow& row, std::uint64_t seed,
                        std::map<std::string, TrainJob>& jobs) const {
  if (row.algorithm.empty()) return;
  if (!is_given(row)) {
    const TrainJob job = job_of(trained_on, row, seed);
    jobs.emplace(job.folder(), job);
    return;
  }
  const std::string file = policy_of(trained_on, row, seed);
  if (fs::exists(file)) return;
  throw ScenarioError(file, "is not there",
                      "train it, or leave out --policies: then it is trained");
}

bool Reproduction::train() {
  std::map<std::string, TrainJob> jobs;
  for (const Experiment& experiment : experiments_) {
    for (const ExperimentRow& row : experiment.rows) {
      for (const std::uint64_t seed : experiment.seeds) {
        want(experiment.trained_on, row, seed, jobs);
      }
    }
  }
  for (const CaseStudy& study : case_studies_) {
    for (const CaseRow& row : study.rows) want(study.trained_on, row.who, row.seed, jobs);
  }
  std::vector<TrainJob> all;
  for (const auto& [folder, job] : jobs) all.push_back(job);
  if (!run_train_jobs(all, std::max(1U, std::thread::hardware_concurrency()))) return false;
  for (const TrainJob& job : all) {
    if (job.has_best()) continue;
    fmt::print(stderr, "{}: no evaluation had every run succeed; its last policy is played\n",
               job.folder());
  }
  return true;
}

std::vector<std::vector<TrainingRecord>> Reproduction::records_of(
    const Experiment& experiment) const {
  std::vector<std::vector<TrainingRecord>> records;
  for (const ExperimentRow& row : experiment.rows) {
    auto& seeds = records.emplace_back();
    for (const std::uint64_t seed : experiment.seeds) {
      const TrainJob job = job_of(experiment.trained_on, row, seed);
      const std::string kept =
          fmt::format("{}/{}-s{}",
                      (fs::path(arguments_.policies) / ".." / "curves").lexically_normal().string(),
                      job.name(), seed);
      seeds.push_back(is_given(row) ? load_training_record(kept + ".progress.csv", kept + ".csv")
                                    : load_training_record(job.folder() + "/progress.csv",
                                                           job.folder() + "/evaluations.csv"));
      const TrainingRecord& record = seeds.back();
      if (record.progress.rows.empty() && record.evaluations.rows.empty()) seeds.pop_back();
    }
  }
  return records;
}

void Reproduction::plan() {
  std::set<std::string> seen;
  cells_.clear();
  for (const Experiment& experiment : experiments_) {
    auto& rows = cells_.emplace_back();
    if (experiment.columns == Experiment::Columns::kTraining) continue;
    for (const ExperimentRow& row : experiment.rows) {
      rows.push_back(cells_of(experiment, row));
      for (const Planned& planned : rows.back()) {
        if (!seen.insert(planned.key).second) continue;
        if (auto result = store_.find(planned.key)) {
          results_.emplace(planned.key, std::move(*result));
        } else {
          left_.push_back(planned);
        }
      }
    }
  }
}

/// By seed, then by order.
std::vector<Reproduction::Planned> Reproduction::cells_of(const Experiment& experiment,
                                                          const ExperimentRow& row) {
  const std::vector<std::uint64_t> seeds =
      row.algorithm.empty() ? std::vector<std::uint64_t>{0} : experiment.seeds;
  std::vector<Planned> cells;
  for (const std::uint64_t seed : seeds) {
    for (const std::int32_t order : experiment.orders) {
      ExperimentCell cell{
          .planner = row.algorithm.empty()
                         ? row.planner
                         : "policy:" + policy_of(experiment.trained_on, row, seed),
          .bound = row.bound,
          .allocator = row.allocator,
          .order = order,
          .horizon = experiment.horizon,
          .trials = std::min(experiment.trials, row.trials.value_or(experiment.trials)),
          .seed = experiment.starts_seed,
          .shield = experiment.shield};
      if (!row.bound.empty()) {  // bounds hold whatever these are: tables may share them
        cell.allocator = "sap";
        cell.horizon.reset();
        cell.shield = false;
      }
      cells.push_back({cell, experiment.scenario, key_of(cell, scenario(experiment.scenario))});
    }
  }
  return cells;
}

bool Reproduction::play() {
  plan();
  ProgressBar bar("evaluating");
  std::size_t before = 0;
  std::size_t total = 0;
  for (const Planned& planned : left_) total += runs_of(planned);
  for (const Planned& planned : left_) {
    const ExperimentCell& cell = planned.cell;
    const std::string who = cell.bound.empty() ? fmt::format("{}+{}", cell.planner, cell.allocator)
                                               : fmt::format("bound {}", cell.bound);
    auto result = run_cell(
        cell, scenario(planned.scenario), clock_ns,
        [&](std::size_t done, std::size_t) {
          bar.update(before + done, total, fmt::format("{}, order {}", who, cell.order));
        },
        &interrupted());
    if (!result) return false;
    store_.keep(planned.key, cell, *result);
    results_.emplace(planned.key, std::move(*result));
    before += runs_of(planned);
  }
  return true;
}

std::size_t Reproduction::runs_of(const Planned& planned) {
  return all_crews(scenario(planned.scenario).line).size() * planned.cell.trials;
}

ExperimentResult Reproduction::result_of(std::size_t experiment) const {
  const Experiment& asked = experiments_.at(experiment);
  if (asked.columns == Experiment::Columns::kTraining) {
    return make_training_table(asked, records_of(asked), paper_of(asked));
  }
  std::vector<RowResults> rows;
  for (const std::vector<Planned>& cells : cells_.at(experiment)) {
    RowResults& results = rows.emplace_back();
    for (const Planned& planned : cells) {
      if (results.empty() || results.back().size() == asked.orders.size()) results.emplace_back();
      results.back().push_back(results_.at(planned.key));
    }
  }
  return make_tables(asked, rows, paper_of(asked));
}

double Reproduction::played_s() const {
  double seconds = 0.0;
  for (const auto& [key, result] : results_) seconds += result.wall_s;
  return seconds;
}

}  // namespace linewright::cli
