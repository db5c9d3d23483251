#include "linewright/scenario/source_files.hpp"

#include <gtest/gtest.h>

#include <string>

#include "linewright/scenario/yaml_reader.hpp"
#include "problems_of.hpp"

namespace linewright::loading {
namespace {

SourceNode merged(const std::string& base, const std::string& over, Problems& problems) {
  const int file = problems.add_file("f");
  SourceNode lower = read_yaml(base, file, problems);
  return merge(std::move(lower), read_yaml(over, file, problems), problems);
}

/// Keys and values on one line, to compare trees with.
std::string text_of(const SourceNode& node) {
  if (node.is_scalar()) return node.text;
  std::string text = node.is_list() ? "[" : "{";
  for (const SourceNode& item : node.items) text += text_of(item) + ",";
  for (const SourceEntry& entry : node.entries)
    text += entry.key + ":" + text_of(entry.value) + ",";
  return text + (node.is_list() ? "]" : "}");
}

std::string merged_text(const std::string& base, const std::string& over) {
  Problems problems;
  const SourceNode root = merged(base, over, problems);
  EXPECT_TRUE(problems.none());
  return text_of(root);
}

TEST(Merge, MappingsAreMergedKeyByKeyInTheOrderOfTheBase) {
  EXPECT_EQ(merged_text("{a: {x: 1, v: 2}, b: 3}", "{c: 5, b: 4, a: {z: 6, x: 7}}"),
            "{a:{x:7,v:2,z:6,},b:4,c:5,}");
}

TEST(Merge, ListsAndValuesAreReplaced) {
  EXPECT_EQ(merged_text("{a: [1, 2], b: {x: 1}, c: 1}", "{a: [3], b: 2, c: {v: 1}}"),
            "{a:[3,],b:2,c:{v:1,},}");
}

TEST(Merge, NullRemovesAKeyAtEveryLevel) {
  EXPECT_EQ(merged_text("{a: {x: 1, v: 2}, b: 3}", "{a: {x: ~}, b: null}"), "{a:{v:2,},}");
}

TEST(Merge, RemovingWhatIsNotThereIsAnError) {
  EXPECT_EQ(problems_of([](Problems& problems) { (void)merged("{a: 1}", "{b: ~}", problems); }),
            "f:1:2: error: there is no key 'b' to remove\n"
            "  hint: null removes a key of the extended file; write {} for an empty entry");
}

TEST(ReadFiles, FolderAndDeviceAreRefused) {
  const auto problems_with = [](const std::string& file) {
    return problems_of([&](Problems& problems) { (void)read_files(file, problems); });
  };
  EXPECT_NE(problems_with(LINEWRIGHT_SOURCE_DIR).find("it is a folder"), std::string::npos);
  EXPECT_NE(problems_with("/dev/zero").find("larger than 1048576 bytes"), std::string::npos);
}

TEST(ReadFiles, ChainsOfFilesAreMergedFromTheLowestUp) {
  Problems problems;
  const SourceNode root = read_files(
      std::string(LINEWRIGHT_SOURCE_DIR) + "/scenarios/duct_line_published.yaml", problems);
  ASSERT_TRUE(problems.none());
  EXPECT_EQ(root.find("extends"), nullptr);
  EXPECT_EQ(root.find("name")->text, "duct_line_published");
  const SourceNode& berth = *root.find("places")->find("outfeed_berth");
  EXPECT_EQ(berth.find("occupied")->text, "on_assignment");
  EXPECT_EQ(berth.find("at")->text, "outfeed");
}

}  // namespace
}  // namespace linewright::loading
