// Golden tests of everything the loader has to say. NAME.yaml is wrong in the way its first line
// tells; NAME.expected holds exactly what the user reads. Run with LINEWRIGHT_UPDATE_EXPECTED=1 in
// the environment to write the expected files anew, then look at what changed.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "linewright/base/diagnostic.hpp"
#include "linewright/scenario/load.hpp"

namespace linewright {
namespace {

namespace fs = std::filesystem;

const fs::path kFolder =
    "tests/diagnostics";  // relative to the repository root, as in the messages

std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<std::string> names_with(const std::string& extension) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(fs::path(LINEWRIGHT_SOURCE_DIR) / kFolder)) {
    if (entry.path().extension() == extension) names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string diagnostics_of(const std::string& file) {
  try {
    (void)load_scenario(file);
  } catch (const ScenarioError& e) {
    return std::string(e.what()) + "\n";
  }
  return "no error\n";
}

class Diagnostics : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override { fs::current_path(LINEWRIGHT_SOURCE_DIR); }
};

TEST_P(Diagnostics, AreExactlyTheExpectedOnes) {
  const std::string found = diagnostics_of((kFolder / (GetParam() + ".yaml")).string());
  const fs::path expected = kFolder / (GetParam() + ".expected");
  if (std::getenv("LINEWRIGHT_UPDATE_EXPECTED") != nullptr) std::ofstream(expected) << found;
  EXPECT_EQ(found, text_of(expected));
}

INSTANTIATE_TEST_SUITE_P(Golden, Diagnostics, testing::ValuesIn(names_with(".expected")),
                         [](const auto& param_info) { return param_info.param; });

TEST(DiagnosticsFolder, EveryScenarioInItIsExpectedToFailOrPartOfAnother) {
  const std::vector<std::string> expected = names_with(".expected");
  for (const std::string& name : names_with(".yaml")) {
    const bool is_part = name.starts_with("part_of_");
    EXPECT_NE(is_part, std::binary_search(expected.begin(), expected.end(), name)) << name;
  }
}

}  // namespace
}  // namespace linewright
