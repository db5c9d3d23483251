// Golden playthroughs: one log per scenario and planner, compared byte for byte. A change of
// behaviour shows as a diff of these files. To accept it: LINEWRIGHT_UPDATE_GOLDEN=1
// build/release/repository_test
// --gtest_filter='Golden*', then read the diff.

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>

#include "linewright/base/files.hpp"
#include "linewright/evaluation/event_log_writer.hpp"
#include "tests/support.hpp"

namespace linewright::testing {
namespace {

class Golden : public ::testing::TestWithParam<std::tuple<std::string, std::string>> {};

TEST_P(Golden, PlaythroughIsUnchanged) {
  const auto& [scenario, planner] = GetParam();
  const Line& line = shipped_line(scenario);
  RunOptions options;
  for (const WorkerKind& kind : line.scenario.line.worker_kinds)
    options.workers.emplace_back(kind.count.max);
  options.order = 1;
  const std::string text = run_line(line, options, 1, planner, "no_spatial").text;
  const std::string file = std::string(LINEWRIGHT_SOURCE_DIR "/tests/golden/") +
                           std::filesystem::path(scenario).stem().string() + "-" + planner +
                           ".jsonl";
  if (std::getenv("LINEWRIGHT_UPDATE_GOLDEN") != nullptr) write_file(file, text);
  std::ifstream in(file, std::ios::binary);
  ASSERT_TRUE(in) << file << " is missing: every scenario has one per planner";
  const std::string expected((std::istreambuf_iterator<char>(in)),
                             std::istreambuf_iterator<char>());
  EXPECT_EQ(text, expected) << file;
}

INSTANTIATE_TEST_SUITE_P(All, Golden,
                         ::testing::Combine(::testing::ValuesIn(shipped_scenarios()),
                                            ::testing::Values("first", "random")));

}  // namespace
}  // namespace linewright::testing
