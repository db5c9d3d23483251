#include "templates.hpp"

#include <gtest/gtest.h>

#include <string>

#include "linewright/scenario/yaml_reader.hpp"
#include "problems_of.hpp"

namespace linewright::loading {
namespace {

SourceNode expanded(const std::string& text) {
  Problems problems;
  SourceNode root = read_yaml(text, problems.add_file("f"), problems);
  expand_templates(root, problems);
  EXPECT_TRUE(problems.none());
  return root;
}

std::string problems_in(const std::string& text) {
  return problems_of([&](Problems& problems) {
    SourceNode root = read_yaml(text, problems.add_file("f"), problems);
    expand_templates(root, problems);
  });
}

std::string keys(const SourceNode& mapping) {
  std::string list;
  for (const SourceEntry& entry : mapping.entries) list += entry.key + " ";
  return list;
}

TEST(Templates, EntryExistsOncePerValueAtItsPlaceInTheOrder) {
  const SourceNode root = expanded("for: {w: [in, out]}\nplaces: {a: 1, b.$w: 2, c: 3}\n");
  EXPECT_EQ(keys(root), "places ");
  EXPECT_EQ(keys(*root.find("places")), "a b.in b.out c ");
}

TEST(Templates, VariableIsReplacedInEveryTextInside) {
  const SourceNode root =
      expanded("for: {w: [in, out]}\np: {b.$w: {x: [q_$w, {r.$w.s: 'on $w'}]}}\n");
  const SourceNode& list = *root.find("p")->find("b.out")->find("x");
  EXPECT_EQ(list.items[0].text, "q_out");
  EXPECT_EQ(list.items[1].find("r.out.s")->text, "on out");
}

TEST(Templates, SeveralVariablesMultiplyAndTheFirstChangesSlowest) {
  const SourceNode root = expanded("for: {w: [a, b], v: [1, 2]}\np: {x.$v.$w: 0, y.$v: 0}\n");
  EXPECT_EQ(keys(*root.find("p")), "x.1.a x.2.a x.1.b x.2.b y.1 y.2 ");
}

TEST(Templates, LongestVariableNameWins) {
  const SourceNode root =
      expanded("for: {s: [a], side: [b]}\np: {x_$side: 0, y_$s: 0, z_$s_e: 0}\n");
  EXPECT_EQ(keys(*root.find("p")), "x_b y_a z_a_e ");
}

TEST(Templates, VariableOutsideOfItsEntriesIsAnError) {
  EXPECT_EQ(problems_in("for: {w: [a]}\np: {x: [q.$w]}\n"),
            "f:2:9: error: 'q.$w': $w has no value here\n"
            "  hint: a variable has a value inside of entries whose name contains $w");
  EXPECT_NE(problems_in("p: {x: [q.$w]}\n").find("there is no such template variable"),
            std::string::npos);
}

TEST(Templates, MadeEntryThatExistsAlreadyIsAnError) {
  EXPECT_EQ(problems_in("for: {w: [a]}\np: {x.a: 1,\n x.$w: 2}\n"),
            "f:3:2: error: key 'x.a' exists twice\n"
            "  hint: the other one is in line 2, one of them from a template");
}

TEST(Templates, ValuesMustBeDifferentWords) {
  EXPECT_NE(problems_in("for: {w: [a, a]}\n").find("listed twice"), std::string::npos);
  EXPECT_NE(problems_in("for: {w: [on]}\n").find("'on' cannot be a value"), std::string::npos);
  EXPECT_NE(problems_in("for: {w: a}\n").find("must be a list"), std::string::npos);
  EXPECT_NE(problems_in("for: {$w: [a]}\n").find("a variable is a word"), std::string::npos);
  EXPECT_NE(problems_in("for: [w]\n").find("'for' must be a mapping"), std::string::npos);
}

TEST(Templates, ExplosionIsRefused) {
  std::string values;
  for (int i = 0; i < 60; ++i) values += (i > 0 ? ", v" : "v") + std::to_string(i);
  std::string text = "for: {";
  for (char c = 'a'; c < 'h'; ++c) text += std::string(1, c) + ": [" + values + "], ";
  EXPECT_NE(
      problems_in(text + "h: [x]}\np: {$a$b$c$d$e$f$g: 1}\n").find("make more than 200000 values"),
      std::string::npos);
}

}  // namespace
}  // namespace linewright::loading
