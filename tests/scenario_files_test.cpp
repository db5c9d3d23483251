// The scenarios and the schema that are shipped fit the loader.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "linewright/base/diagnostic.hpp"
#include "linewright/scenario/load.hpp"

namespace linewright {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = LINEWRIGHT_SOURCE_DIR;

TEST(ScenarioFiles, AllOfThemLoad) {
  int count = 0;
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / "scenarios")) {
    if (entry.path().extension() != ".yaml") continue;
    ++count;
    try {
      const Scenario scenario = load_scenario(entry.path().string());
      EXPECT_EQ(scenario.line.name, entry.path().stem().string());
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
