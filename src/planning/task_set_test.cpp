#include "linewright/planning/task_set.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace linewright {
namespace {

std::vector<int> ids_of(const TaskSet& set) {
  std::vector<int> ids;
  set.each([&](TaskId task) { ids.push_back(task.value); });
  return ids;
}

TEST(TaskSet, HoldsWhatWasInserted) {
  TaskSet set;
  EXPECT_TRUE(set.empty());
  for (const int id : {1000, 63, 64, 0}) set.insert(TaskId(id));
  set.erase(TaskId(64));
  EXPECT_EQ(ids_of(set), (std::vector{0, 63, 1000}));
  EXPECT_EQ(set.size(), 3U);
  EXPECT_TRUE(set.contains(TaskId(63)));
  EXPECT_FALSE(set.contains(TaskId(64)));
}

TEST(TaskSet, TakesTheSelectableTasksWithoutTheBitBehindTheLastOne) {
  SimulationState state;
  state.selectable = {0b10110, 0b11};
  EXPECT_EQ(ids_of(TaskSet::selectable(state, 4)), (std::vector{1, 2}));
  EXPECT_EQ(ids_of(TaskSet::selectable(state, 65)), (std::vector{1, 2, 4, 64}));
  EXPECT_TRUE(TaskSet::selectable(state, 0).empty());
}

}  // namespace
}  // namespace linewright
