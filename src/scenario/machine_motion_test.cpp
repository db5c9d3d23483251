#include "machine_motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "linewright/scenario/load.hpp"

namespace linewright::loading {
namespace {

/// The marked positions of a machine, as a list of names.
std::string marked(const Machine& machine, const std::vector<bool>& positions) {
  std::string list;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (positions[i]) list += machine.positions[i] + " ";
  }
  return list;
}

TEST(MachineMotion, FollowsTheGantryOfTheDuctLine) {
  const LineModel line =
      load_scenario(std::string(LINEWRIGHT_SOURCE_DIR) + "/scenarios/duct_line.yaml").line;
  const auto gantry =
      std::find_if(line.machines.begin(), line.machines.end(),
                   [](const Machine& machine) { return machine.name == "inner_gantry"; });
  ASSERT_NE(gantry, line.machines.end());
  const MachineId id(static_cast<std::size_t>(gantry - line.machines.begin()));
  const MachineMotion motion = machine_motion(line, id);
  EXPECT_EQ(marked(*gantry, motion.idle), "home at_inner at_outer at_cage ");
  EXPECT_EQ(marked(*gantry, motion.held), "cut_part duct_inner duct_outer ");
}

/// A hoist that only ever stands at `low` when idle, and homes from three positions.
LineModel hoist_line() {
  LineModel line;
  Machine hoist;
  hoist.positions = {"home", "low", "middle", "high"};
  hoist.start = 1;
  hoist.travel.assign(4, std::vector<Tick>(4, 0));
  hoist.homing = Homing{0, {0, 8, 5, 12}, 0};
  line.machines = {hoist};
  Operation lift;
  lift.uses = {{MachineId(0), 2, 1}};
  line.operations = {lift};
  return line;
}

TEST(MachineMotion, OnItsWayHomeItPassesPositionsWithShorterHomingTimes) {
  const LineModel line = hoist_line();
  const MachineMotion motion = machine_motion(line, MachineId(0));
  EXPECT_EQ(marked(line.machines[0], motion.idle), "home low ");
  EXPECT_EQ(marked(line.machines[0], called_from(line.machines[0], motion)), "home low middle ");
}

TEST(MachineMotion, WithoutPositionsThereIsNothingToFollow) {
  LineModel line;
  line.machines = {Machine{}};
  EXPECT_TRUE(machine_motion(line, MachineId(0)).idle.empty());
}

}  // namespace
}  // namespace linewright::loading
