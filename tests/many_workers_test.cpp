// As many workers and carriers as the format allows: loading, drawing, deciding, and what is said
// beyond.

#include <gtest/gtest.h>

#include "linewright/allocation/allocator.hpp"
#include "linewright/base/diagnostic.hpp"
#include "linewright/planning/episode.hpp"
#include "linewright/planning/planner.hpp"
#include "linewright/scenario/load.hpp"
#include "tests/support.hpp"

namespace linewright::testing {
namespace {

/// `kinds` kinds of workers and a carrier, `count` of each. The one task takes a worker of the
/// first kind with a carrier.
std::string crowd(const std::string& count, int kinds) {
  std::string text =
      "schema: line/1\nname: crowd\nhorizon: 2000\n"
      "order: {product: p, quantity: 1000, finished_in: done}\n"
      "places: {stock: {of: p, initial: order}, done: {of: p}}\n"
      "carriers: {cage: {count: w0, capacity: 4, moved_by: w0}}\n";
  std::string workers;
  std::string poses[3];
  std::string slots;
  for (int k = 0; k < kinds; ++k) {
    const std::string name = "w" + std::to_string(k);
    workers += "  " + name + ": {count: " + count + "}\n";
    for (int s = 0; s < 3; ++s) {
      poses[s] += name + ": [" + std::to_string(7 * s) + ", " + std::to_string(s * s) + ", 0], ";
    }
    slots += (k == 0 ? "" : ", ") + name + ": 5000";
  }
  text += "workers:\n" + workers + "stations:\n";
  for (int s = 0; s < 3; ++s) {
    text += "  s" + std::to_string(s) + ": {" + poses[s] + "slots: {" + slots + "}}\n";
  }
  return text +
         "tasks:\n"
         "  carry:\n"
         "    crew: {w0: 1, cage: empty}\n"
         "    when: [stock.available > 0]\n"
         "    reserves: [stock]\n"
         "    max_running: 10000\n"
         "    steps: [{w0: [{fetch: cage}, {go: s2}, {transfer: [stock, cage]}, {go: s0}, "
         "{transfer: [cage, done]}]}]\n";
}

TEST(ManyWorkers, TenThousandOfEachOfTwoKindsRun) {
  const Scenario scenario = load_scenario_text(crowd("10000", 2), "crowd.yaml");
  const Simulator simulator(std::make_shared<const LineModel>(scenario.line));
  const auto planner = PlannerRegistry::make("first", simulator);
  SimulationState state;
  for (const std::string& name : allocator_names()) {
    const auto allocator = make_allocator(name, simulator);
    const RunSetup setup = sample_setup(simulator.line(), {}, 1);
    EXPECT_EQ(setup.worker_start.at(1).size(), 10'000U);
    EXPECT_EQ(setup.carrier_start.at(0).size(), 10'000U);
    EXPECT_EQ(run_episode(simulator, state, setup, 1, *planner, *allocator), RunStatus::kFinished);
    EXPECT_EQ(state.decisions, 1000);
  }
}

TEST(ManyWorkers, AStationStartsNoMoreThanItHasSlotsFor) {
  const LineModel line = load_scenario_text(crowd("10000", 1), "crowd.yaml").line;
  std::vector<int> at(3);
  const RunSetup setup = sample_setup(line, {}, 3);
  for (const StationId station : setup.worker_start.at(0)) ++at[station.index()];
  for (const int many : at) EXPECT_LE(many, 5000);
}

TEST(ManyWorkers, OneMoreIsAnErrorOfTheScenario) {
  try {
    static_cast<void>(load_scenario_text(crowd("10001", 1), "crowd.yaml"));
    FAIL();
  } catch (const ScenarioError& error) {
    EXPECT_NE(std::string(error.what()).find("from 0 to 10000"), std::string::npos) << error.what();
  }
}

TEST(ManyWorkers, MoreThanStatesCanNumberAreAnErrorOfTheRun) {
  const LineModel line = load_scenario_text(crowd("10000", 4), "crowd.yaml").line;
  try {
    static_cast<void>(sample_setup(line, {}, 1));
    FAIL();
  } catch (const ScenarioError& error) {
    EXPECT_NE(std::string(error.what()).find("40000 workers are too many for one run"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace linewright::testing
