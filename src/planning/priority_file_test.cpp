#include "linewright/planning/priority_file.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "linewright/base/diagnostic.hpp"
#include "linewright/base/files.hpp"

namespace linewright {
namespace {

constexpr std::uint64_t kHash = 0x123456789abcdef0;

LineModel line_of_three() {
  LineModel line;
  line.name = "three";
  for (const char* name : {"cut", "glue", "pack"}) {
    line.tasks.push_back(
        {.name = name, .number = static_cast<std::int32_t>(line.tasks.size() + 1)});
  }
  return line;
}

std::vector<TaskId> tasks(const std::vector<int>& ids) {
  std::vector<TaskId> all;
  for (const int id : ids) all.emplace_back(id);
  return all;
}

std::string good_text() {
  return priority_text(
      line_of_three(), kHash,
      {{"sap", {.order = tasks({2, 0, 1}), .makespan = 12.5, .success_rate = 1.0, .runs = 7}}});
}

std::string complaint(const std::string& text, std::uint64_t hash = kHash) {
  try {
    static_cast<void>(parse_priority_file(text, "three.priority", line_of_three(), hash));
  } catch (const ScenarioError& error) {
    return error.what();
  }
  return "";
}

TEST(PriorityFile, GivesBackTheOrderThatWasWritten) {
  const auto entries = parse_priority_file(good_text(), "f", line_of_three(), kHash);
  ASSERT_EQ(entries.size(), 1U);
  EXPECT_EQ(entries[0].allocator, "sap");
  EXPECT_EQ(entries[0].tuned.order, tasks({2, 0, 1}));
  EXPECT_EQ(entries[0].tuned.makespan, 12.5);
  EXPECT_EQ(entries[0].tuned.runs, 7U);
  EXPECT_EQ(priority_file_of("scenarios/duct_line.yaml"), "scenarios/duct_line.priority");
}

TEST(PriorityFile, HasTheOrderOfTheAllocatorOrElseTheFirst) {
  const std::string file = ::testing::TempDir() + "/linewright_orders.priority";
  write_file(file, priority_text(line_of_three(), kHash,
                                 {{"sap", {.order = tasks({2, 0, 1})}},
                                  {"first_idle", {.order = tasks({1, 0, 2})}}}));
  PriorityKey key{.scenario_file = ::testing::TempDir() + "/linewright_orders.yaml",
                  .scenario_hash = kHash,
                  .allocator = "first_idle"};
  EXPECT_EQ(load_priority(line_of_three(), key), tasks({1, 0, 2}));
  key.allocator = "longest_path";
  EXPECT_EQ(load_priority(line_of_three(), key), tasks({2, 0, 1}));
  std::remove(file.c_str());
}

TEST(PriorityFile, IsRefusedForAnotherScenario) {
  EXPECT_NE(complaint(good_text(), kHash + 1).find("another version"), std::string::npos);
}

TEST(PriorityFile, SaysWhatIsWrongWithIt) {
  const auto with = [](const std::string& from, const std::string& to) {
    std::string text = good_text();
    return text.replace(text.find(from), from.size(), to);
  };
  const std::vector<std::pair<std::string, std::string>> wrong{
      {"", "no priority file"},
      {"[1, 2]", "no priority file"},
      {with("\"order\"", "\"ordr\""), "did you mean 'order'?"},
      {with("\"orders\"", "\"list\""), "unknown key"},
      {with("12.5", "\"12\""), "no number"},
      {with("priority/1", "priority/9"), "format"},
      {with("\"glue\"", "\"cut\""), "twice"},
      {with("\"glue\"", "\"glu\""), "did you mean 'glue'?"},
      {with("\"glue\"", "7"), "no name"},
      {with("\"pack\",", ""), "every task"},
  };
  for (const auto& [text, message] : wrong) {
    EXPECT_NE(complaint(text).find(message), std::string::npos) << text << complaint(text);
  }
}

TEST(PriorityFile, ThatIsMissingNamesTheCommandThatWritesIt) {
  try {
    static_cast<void>(load_priority(line_of_three(), {.scenario_file = "no/such.yaml"}));
    FAIL();
  } catch (const ScenarioError& error) {
    EXPECT_NE(std::string(error.what()).find("linewright tune-priority no/such.yaml"),
              std::string::npos);
  }
  EXPECT_FALSE(find_priority(line_of_three(), {.scenario_file = "no/such.yaml"}));
}

}  // namespace
}  // namespace linewright
