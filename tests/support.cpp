#include "tests/support.hpp"

#include <algorithm>
#include <map>

#include "linewright/allocation/allocator.hpp"
#include "linewright/evaluation/event_log_writer.hpp"
#include "linewright/planning/episode.hpp"
#include "linewright/planning/planner.hpp"
#include "linewright/scenario/load.hpp"

namespace linewright::testing {

const Line& shipped_line(const std::string& file) {
  static std::map<std::string, Line> loaded;
  const auto [entry, is_new] = loaded.try_emplace(file);
  if (is_new) {
    entry->second.scenario = load_scenario(std::string(LINEWRIGHT_SOURCE_DIR) + "/" + file);
    entry->second.simulator =
        std::make_unique<Simulator>(std::make_shared<const LineModel>(entry->second.scenario.line));
  }
  return entry->second;
}

namespace {

std::vector<std::string> scenarios_in(const std::string& folder) {
  const std::filesystem::path root(LINEWRIGHT_SOURCE_DIR);
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder)) {
    // scenarios/maps holds maps, whose files end in .yaml as well.
    if (entry.path().extension() == ".yaml" && entry.path().parent_path().filename() != "maps") {
      files.push_back(std::filesystem::relative(entry.path(), root).generic_string());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

std::vector<std::string> shipped_scenarios() { return scenarios_in("scenarios"); }

std::vector<std::string> awkward_scenarios() { return scenarios_in("tests/data/awkward"); }

LoggedRun run_line(const Line& line, const RunOptions& options, std::uint64_t seed,
                   const std::string& planner, const std::string& allocator) {
  LoggedRun run;
  const Simulator& simulator = *line.simulator;
  const auto who_plans = PlannerRegistry::make(planner, simulator);
  const auto who_allocates = make_allocator(allocator, simulator);
  run_episode(simulator, run.state, sample_setup(simulator.line(), options, seed), seed, *who_plans,
              *who_allocates, {.log = &run.log});
  run.text = event_log_text(line.scenario, run.log, simulator.progress(run.state));
  return run;
}

RunOptions crew_of(std::vector<int> counts, int order) {
  RunOptions options;
  for (const int count : counts) options.workers.emplace_back(count);
  if (order > 0) options.order = order;
  return options;
}

}  // namespace linewright::testing
