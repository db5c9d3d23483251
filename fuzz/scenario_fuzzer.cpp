// Any text is either a scenario, which then runs, or a ScenarioError: nothing else may come out.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>

#include "linewright/allocation/allocator.hpp"
#include "linewright/base/diagnostic.hpp"
#include "linewright/planning/episode.hpp"
#include "linewright/scenario/load.hpp"

namespace {

/// A short random run: whatever the loader lets through, the simulator must be able to play.
void run(const linewright::Scenario& scenario) {
  using namespace linewright;
  const Simulator simulator(std::make_shared<const LineModel>(scenario.line));
  const auto planner = PlannerRegistry::make("random", simulator);
  const auto allocator = make_allocator("no_spatial", simulator);
  RunOptions options;
  options.horizon = 300;
  SimulationState state;
  EventLog log;
  run_episode(simulator, state, sample_setup(simulator.line(), options, 1), 1, *planner, *allocator,
              {.log = &log});
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    linewright::LoadOptions options;
    options.threads = 1;
    options.most_route_work = 500'000;  // some milliseconds
    run(linewright::load_scenario_text(text, "fuzz.yaml", options));
  } catch (const linewright::ScenarioError&) {
  }
  return 0;
}
