#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "linewright/scenario/scenario.hpp"
#include "linewright/simulation/simulator.hpp"

namespace linewright::testing {

/// A scenario of the repository (`scenarios/...`), loaded once per process, with its simulator.
struct Line {
  Scenario scenario;
  std::unique_ptr<Simulator> simulator;
};
const Line& shipped_line(const std::string& file);

/// Every scenario file of the repository, in order of their names.
std::vector<std::string> shipped_scenarios();

/// Small lines with late joiners, releases, berths and waiting in unusual places
/// (tests/data/awkward).
std::vector<std::string> awkward_scenarios();

/// A run from start to end, as a log text.
struct LoggedRun {
  SimulationState state;
  EventLog log;
  std::string text;
};
LoggedRun run_line(const Line& line, const RunOptions& options, std::uint64_t seed,
                   const std::string& planner, const std::string& allocator);

/// Workers by kind: {humans, robots} for the duct line.
RunOptions crew_of(std::vector<int> counts, int order = 0);

}  // namespace linewright::testing
