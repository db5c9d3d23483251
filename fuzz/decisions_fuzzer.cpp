// Any text is either a record of decisions, which is then replayed, or a ScenarioError.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "linewright/allocation/allocator.hpp"
#include "linewright/base/diagnostic.hpp"
#include "linewright/evaluation/recorded_run.hpp"
#include "linewright/planning/replay.hpp"
#include "linewright/scenario/load.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace linewright;
  static const Simulator simulator(
      std::make_shared<const LineModel>(load_scenario("scenarios/duct_line_published.yaml").line));
  static const auto allocator = make_allocator("first_idle", simulator);
  try {
    const RecordedRun run = read_recorded_run(
        std::string(reinterpret_cast<const char*>(data), size), "fuzz.json", simulator.line());
    SimulationState state;
    EventLog log;
    replay(simulator, state, run.setup, run.decisions, *allocator, &log);
    static_cast<void>(compare_milestones(run, simulator.line(), log));
  } catch (const ScenarioError&) {
  }
  return 0;
}
