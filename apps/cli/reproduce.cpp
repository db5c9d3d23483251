#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <thread>

#include "common.hpp"
#include "linewright/base/diagnostic.hpp"
#include "linewright/base/files.hpp"
#include "linewright/experiments/cell.hpp"
#include "linewright/experiments/experiment.hpp"
#include "linewright/experiments/paper.hpp"
#include "linewright/experiments/render.hpp"
#include "linewright/experiments/table.hpp"
#include "train_jobs.hpp"

namespace linewright::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPaperTables = "tables.yaml";  ///< beside the experiments

struct ReproduceArguments {
  std::string what;
  bool quick = false;
  std::string out = "out/reproduce";
  std::string policies;
};

/// What is in a folder, by name; empty when it is none.
std::vector<fs::path> entries_of(const std::string& folder) {
  std::vector<fs::path> entries;
  if (!fs::is_directory(folder)) return entries;
  for (const auto& entry : fs::directory_iterator(folder)) entries.push_back(entry.path());
  std::sort(entries.begin(), entries.end());
  return entries;
}

/// The experiments that are asked for: a file, a folder, or the name of a folder of experiments/.
std::vector<std::string> experiment_files(const std::string& what) {
  if (fs::is_regular_file(what)) return {what};
  std::vector<std::string> folders{what};
  std::vector<std::string> known;
  for (const std::string& shipped : shipped_folders("experiments")) {
    folders.push_back(shipped + "/" + what);
    for (const fs::path& entry : entries_of(shipped)) known.push_back(entry.filename().string());
  }
  for (const std::string& folder : folders) {
    std::vector<std::string> files;
    for (const fs::path& file : entries_of(folder)) {
      if (file.extension() != ".yaml" || file.filename() == kPaperTables) continue;
      files.push_back(file.string());
    }
    if (!files.empty()) return files;
  }
  throw ScenarioError({}, fmt::format("there are no experiments {}", in_quotes(what)),
                      known.empty() ? "name a file" : name_hint(what, known));
}

std::optional<PaperTables> paper_tables(const std::string& experiment_file) {
  const std::string file = beside(experiment_file, kPaperTables);
  if (!fs::exists(file)) return std::nullopt;
  return load_paper_tables(file);
}

/// Everything that `reproduce` does, in its order.
class Reproduction {
 public:
  explicit Reproduction(const ReproduceArguments& arguments)
      : arguments_(arguments), store_(arguments.out + "/results") {
    const std::vector<std::string> files = experiment_files(arguments.what);
    for (const std::string& file : files) {
      experiments_.push_back(load_experiment(file, arguments.quick));
      scenario(experiments_.back().scenario);
    }
    paper_ = paper_tables(files.front());
  }

  int run() {
    if (!train()) return stopped();
    plan();
    if (!play()) return stopped();
    write();
    return kOk;
  }

 private:
  /// One row, seed and order of an experiment.
  struct Planned {
    ExperimentCell cell;
    std::string scenario;
    std::string key;
  };

  const Scenario& scenario(const std::string& file) {
    const auto found = scenarios_.find(file);
    if (found != scenarios_.end()) return found->second;
    return scenarios_.emplace(file, load(file)).first->second;
  }

  int stopped() const {
    report(fmt::format("interrupted: the same command goes on from what is in {}", arguments_.out));
    return kInterrupted;
  }

  [[nodiscard]] TrainJob job_of(const std::string& algorithm, const std::string& file,
                                std::uint64_t seed) const {
    return {algorithm, file, seed, arguments_.out + "/train/" + fs::path(file).stem().string()};
  }

  [[nodiscard]] std::string policy_of(const Experiment& experiment, const ExperimentRow& row,
                                      std::uint64_t seed) const {
    if (arguments_.policies.empty()) {
      return job_of(row.algorithm, experiment.scenario, seed).policy();
    }
    return fmt::format("{}/{}/{}.safetensors", arguments_.policies,
                       fs::path(row.algorithm).stem().string(), seed);
  }

  bool train() {
    std::map<std::string, TrainJob> jobs;
    for (const Experiment& experiment : experiments_) {
      for (const ExperimentRow& row : experiment.rows) {
        if (row.algorithm.empty()) continue;
        for (const std::uint64_t seed : experiment.seeds) {
          const TrainJob job = job_of(row.algorithm, experiment.scenario, seed);
          if (arguments_.policies.empty())
            jobs.emplace(job.folder(), job);
          else
            need_policy(policy_of(experiment, row, seed));
        }
      }
    }
    std::vector<TrainJob> all;
    for (const auto& [folder, job] : jobs) all.push_back(job);
    return run_train_jobs(all, std::max(1U, std::thread::hardware_concurrency()));
  }

  void need_policy(const std::string& file) const {
    if (fs::exists(file)) return;
    throw ScenarioError(file, "is not there",
                        "train it, or leave out --policies: then it is trained");
  }

  /// The cells of all experiments, and what is there of their results. Several may share one.
  void plan() {
    std::set<std::string> seen;
    for (const Experiment& experiment : experiments_) {
      for (const ExperimentRow& row : experiment.rows) {
        cells_.push_back(cells_of(experiment, row));
        for (const Planned& planned : cells_.back()) {
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
  std::vector<Planned> cells_of(const Experiment& experiment, const ExperimentRow& row) {
    const std::vector<std::uint64_t> seeds =
        row.algorithm.empty() ? std::vector<std::uint64_t>{0} : experiment.seeds;
    std::vector<Planned> cells;
    for (const std::uint64_t seed : seeds) {
      for (const std::int32_t order : experiment.orders) {
        ExperimentCell cell{.planner = row.algorithm.empty()
                                           ? row.planner
                                           : "policy:" + policy_of(experiment, row, seed),
                            .allocator = row.allocator,
                            .order = order,
                            .horizon = experiment.horizon,
                            .trials = experiment.trials,
                            .seed = experiment.starts_seed,
                            .shield = experiment.shield};
        cells.push_back({cell, experiment.scenario, key_of(cell, scenario(experiment.scenario))});
      }
    }
    return cells;
  }

  bool play() {
    ProgressBar bar("evaluating");
    std::size_t before = 0;
    std::size_t total = 0;
    for (const Planned& planned : left_) total += runs_of(planned);
    for (const Planned& planned : left_) {
      auto result = run_cell(
          planned.cell, scenario(planned.scenario), clock_ns,
          [&](std::size_t done, std::size_t) {
            bar.update(before + done, total,
                       fmt::format("{}+{}, order {}", planned.cell.planner, planned.cell.allocator,
                                   planned.cell.order));
          },
          &interrupted());
      if (!result) return false;
      store_.keep(planned.key, planned.cell, *result);
      results_.emplace(planned.key, std::move(*result));
      before += runs_of(planned);
    }
    return true;
  }

  std::size_t runs_of(const Planned& planned) {
    return all_crews(scenario(planned.scenario).line).size() * planned.cell.trials;
  }

  /// `row`: where the cells of the experiment's rows begin; moves on behind them.
  ExperimentResult result_of(const Experiment& experiment, std::size_t& row) const {
    std::vector<RowResults> rows;
    for (std::size_t r = 0; r < experiment.rows.size(); ++r, ++row) {
      RowResults& results = rows.emplace_back();
      for (const Planned& planned : cells_[row]) {
        if (results.empty() || results.back().size() == experiment.orders.size()) {
          results.emplace_back();
        }
        results.back().push_back(results_.at(planned.key));
      }
    }
    return make_tables(experiment, rows, paper_ ? &*paper_ : nullptr);
  }

  void write() const {
    std::string all;
    std::size_t row = 0;
    for (const Experiment& experiment : experiments_) {
      const ExperimentResult result = result_of(experiment, row);
      const std::string file = arguments_.out + "/tables/" + experiment.name;
      write_file(file + ".csv", result_csv(result));
      write_file(file + ".tex", result_latex(result));
      write_file(file + ".json", result_json(result));
      write_figures(result);
      const std::string text = result_markdown(result);
      write_file(file + ".md", text);
      all += text;
    }
    print(all);
    print(fmt::format("Tables as CSV, Markdown, LaTeX and JSON: {0}/tables; figures: {0}/figures\n",
                      arguments_.out));
  }

  void write_figures(const ExperimentResult& result) const {
    for (std::size_t t = 0; t < result.tables.size(); ++t) {
      write_file(fmt::format("{}/figures/{}_{}.svg", arguments_.out, result.experiment.name,
                             name_of(result.tables[t].metric)),
                 result_figure(result, t));
    }
  }

  const ReproduceArguments& arguments_;
  CellStore store_;
  std::vector<Experiment> experiments_;
  std::optional<PaperTables> paper_;
  std::map<std::string, Scenario> scenarios_;
  std::vector<std::vector<Planned>> cells_;    ///< by row of all experiments
  std::vector<Planned> left_;                  ///< to be played
  std::map<std::string, CellResult> results_;  ///< by key
};

}  // namespace

Command add_reproduce(CLI::App& app) {
  auto arguments = std::make_shared<ReproduceArguments>();
  app.add_option("what", arguments->what,
                 "`paper`, or a file or folder of experiments (docs/formats/experiment.md)")
      ->required();
  app.add_flag("--quick", arguments->quick, "Fewer seeds and runs, as the experiments say");
  app.add_option("--out", arguments->out, "Folder for runs, results and tables")
      ->capture_default_str();
  app.add_option("--policies", arguments->policies,
                 "Take trained policies FOLDER/ALGORITHM/SEED.safetensors instead of training")
      ->type_name("FOLDER");
  app.footer(
      "What is there already is not done again; Ctrl-C and the same command go on.\n"
      "Example:\n  linewright reproduce paper --policies policies/seeds");
  return [arguments] { return Reproduction(*arguments).run(); };
}

}  // namespace linewright::cli
