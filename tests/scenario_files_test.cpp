// The scenarios and the schema that are shipped fit the loader.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "linewright/base/diagnostic.hpp"
#include "linewright/scenario/load.hpp"
#include "tests/support.hpp"

namespace linewright {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = LINEWRIGHT_SOURCE_DIR;

TEST(ScenarioFiles, AllOfThemLoad) {
  int count = 0;
  for (const std::string& file : testing::shipped_scenarios()) {
    ++count;
    try {
      const Scenario scenario = load_scenario((kRoot / file).string());
      EXPECT_EQ(scenario.line.name, fs::path(file).stem().string());
    } catch (const ScenarioError& e) {
      ADD_FAILURE() << e.what();
    }
  }
  EXPECT_GE(count, 4);
}

TEST(ScenarioSchema, ShippedFileIsWhatTheLoaderChecksAgainst) {
  const fs::path file = kRoot / "docs/formats/scenario.schema.json";
  std::ifstream stream(file, std::ios::binary);
  const std::string shipped{std::istreambuf_iterator<char>(stream), {}};
  EXPECT_TRUE(shipped == scenario_json_schema())
      << "write it anew: linewright schema > docs/formats/scenario.schema.json";
}

}  // namespace
}  // namespace linewright
