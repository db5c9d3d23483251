#include "linewright/base/files.hpp"

#include <gtest/gtest.h>

#include <filesystem>

namespace linewright {
namespace {

TEST(ProgramFile, IsThisTest) {
  EXPECT_EQ(std::filesystem::path(program_file()).filename(), "base_test");
}

TEST(ShippedFolders, AreFoundHereAndAboveTheProgram) {
  // Built in a folder of the repository, which has these.
  const std::vector<std::string> folders = shipped_folders("algorithms");
  ASSERT_FALSE(folders.empty());
  for (const std::string& folder : folders) {
    EXPECT_TRUE(std::filesystem::exists(folder + "/base.yaml")) << folder;
  }
  EXPECT_TRUE(shipped_folders("no such folder").empty());
}

}  // namespace
}  // namespace linewright
