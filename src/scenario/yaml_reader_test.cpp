#include "linewright/scenario/yaml_reader.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "problems_of.hpp"

namespace linewright::loading {
namespace {

SourceNode read(const std::string& text) {
  Problems problems;
  SourceNode root = read_yaml(text, problems.add_file("f"), problems);
  EXPECT_TRUE(problems.none());
  return root;
}

std::string problems_in(const std::string& text) {
  return problems_of(
      [&](Problems& problems) { (void)read_yaml(text, problems.add_file("f"), problems); });
}

TEST(YamlReader, EveryValueKnowsLineAndColumn) {
  const SourceNode root = read("a: 1\nb:\n  c: [x, 'y']\n");
  const SourceNode& list = *root.find("b")->find("c");
  EXPECT_EQ(list.mark.line, 3);
  EXPECT_EQ(list.mark.column, 6);
  EXPECT_EQ(list.items[1].mark.column, 10);
  EXPECT_FALSE(list.items[0].was_quoted);
  EXPECT_TRUE(list.items[1].was_quoted);
}

TEST(YamlReader, AliasStandsForACopy) {
  const SourceNode root = read("a: &x {k: 1}\nb: *x\n");
  EXPECT_EQ(root.find("b")->find("k")->text, "1");
}

TEST(YamlReader, DuplicateKeysAreReportedAndTheFirstIsKept) {
  EXPECT_EQ(problems_in("a: 1\nb: 2\na: 3\n"),
            "f:3:1: error: key 'a' is written twice\n  hint: the first one is in line 1; keep one "
            "of them");
}

TEST(YamlReader, AliasBombIsRefused) {
  std::string text = "a: &a [x, x, x, x, x, x, x, x]\n";
  for (char c = 'b'; c < 'k'; ++c) {
    text += std::string(1, c) + ": &" + c + " [";
    for (int i = 0; i < 8; ++i) text += std::string(i > 0 ? ", *" : "*") + static_cast<char>(c - 1);
    text += "]\n";
  }
  EXPECT_NE(problems_in(text).find("more than 200000 values"), std::string::npos);
}

TEST(YamlReader, NestingThatGrowsThroughAliasesIsRefused) {
  std::string text = "k0: &a0 x\n";
  for (int i = 1; i < 100; ++i) text += fmt::format("k{}: &a{} [[[[*a{}]]]]\n", i, i, i - 1);
  EXPECT_NE(problems_in(text).find("levels of nesting"), std::string::npos);
}

TEST(YamlReader, LongTextsCountAsManyValues) {
  std::string text = "a: &a " + std::string(500'000, 'x') + "\nb: [*a";
  for (int i = 0; i < 1000; ++i) text += ", *a";
  EXPECT_NE(problems_in(text + "]\n").find("more than 200000 values"), std::string::npos);
}

TEST(YamlReader, AliasOfItselfIsRefused) {
  EXPECT_NE(problems_in("a: &a [*a]\n").find("this alias is inside of what it stands for"),
            std::string::npos);
}

TEST(YamlReader, DeepNestingIsRefused) {
  std::string mappings = "a: 1";
  for (int i = 0; i < 1000; ++i)
    mappings = "{a: " + mappings.substr(mappings[0] == '{' ? 0 : 3) + "}";
  EXPECT_NE(problems_in(mappings).find("levels of nesting"), std::string::npos);
  const std::string lists = std::string(10'000, '[') + std::string(10'000, ']');
  EXPECT_NE(problems_in("a: " + lists).find("levels of nesting"), std::string::npos);
  EXPECT_NE(problems_in("a: " + std::string(10'000, '[')), "");
}

TEST(YamlReader, WhatIsNotTextIsRefusedWithItsPlace) {
  EXPECT_NE(problems_in(std::string("a: 1\nb: \0x", 10)).find("f:2:4: error: byte 0x00"),
            std::string::npos);
  EXPECT_NE(problems_in("a: \x04").find("f:1:4: error: byte 0x04"), std::string::npos);
  EXPECT_NE(problems_in("a: \xff\xfe").find("byte 0xff"), std::string::npos);
  EXPECT_NE(problems_in("\xff\xfe" + std::string("a\0", 2)).find("byte 0xff"), std::string::npos);
  EXPECT_EQ(problems_in("a: M\xc3\xbcller"), "");
}

TEST(YamlReader, OneFileHoldsOneDocument) {
  EXPECT_NE(problems_in("a: 1\n---\nb: 2\n").find("second YAML document"), std::string::npos);
  EXPECT_NE(problems_in("").find("the file is empty"), std::string::npos);
}

TEST(YamlReader, TagsAndComplexKeysAreRefused) {
  EXPECT_NE(problems_in("a: !!binary x").find("is not allowed"), std::string::npos);
  EXPECT_NE(problems_in("? [a, b]\n: 1\n").find("a key must be a single word"), std::string::npos);
  EXPECT_NE(problems_in("~: 1\n").find("a key must be a single word"), std::string::npos);
}

TEST(YamlReader, ContentHashIgnoresLayoutOnly) {
  const auto hash = [](const std::string& text) { return content_hash(read(text)); };
  EXPECT_EQ(hash("a: 1\nb: [x, y]\n"), hash("# comment\n{a: '1', b:   [x,y]}"));
  EXPECT_NE(hash("a: 1\nb: 2\n"), hash("b: 2\na: 1\n"));  // the order of operations has a meaning
  EXPECT_NE(hash("a: 1"), hash("a: 2"));
  EXPECT_NE(hash("a: [x, y]"), hash("a: [xy]"));
  EXPECT_NE(hash("a: []"), hash("a: {}"));
}

}  // namespace
}  // namespace linewright::loading
