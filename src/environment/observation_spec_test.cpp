#include "linewright/environment/observation_spec.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "linewright/base/diagnostic.hpp"

namespace linewright {
namespace {

using Encoder = TokenGroup::Encoder;

ObservationSpec sample() {
  ObservationSpec spec;
  spec.groups = {{"human", Encoder::kShared, {"h0", "h1"}, {{"x", "y"}}},
                 {"machines", Encoder::kOwn, {"saw", "press"}, {{"busy"}, {"busy", "heat"}}},
                 {"tasks", Encoder::kNamed, {"cut", "wait"}, {{"open"}}},
                 {"global", Encoder::kOwn, {"global"}, {{"time"}}}};
  spec.actions = {"cut", "wait"};
  return spec;
}

std::string complaint(std::string json) {
  try {
    static_cast<void>(observation_spec_from_json(json, "p"));
    return "";
  } catch (const ScenarioError& error) {
    return error.diagnostics().front().message;
  }
}

/// The complaint about the sample with `from` replaced.
std::string complaint_with(const std::string& from, const std::string& to) {
  std::string json = to_json(sample());
  json.replace(json.find(from), from.size(), to);
  return complaint(json);
}

TEST(ObservationSpec, CountsTokensAndFeatures) {
  EXPECT_EQ(sample().token_count(), 7U);
  EXPECT_EQ(sample().feature_count(), 4U + 3U + 2U + 1U);
}

TEST(ObservationSpec, ComesBackFromItsText) {
  EXPECT_EQ(observation_spec_from_json(to_json(sample()), "p"), sample());
}

TEST(ObservationSpec, TextIsStable) {
  ObservationSpec spec = sample();
  spec.groups.erase(spec.groups.begin(), spec.groups.begin() + 2);
  EXPECT_EQ(to_json(spec),
            R"({"version":1,"groups":[)"
            R"({"name":"tasks","encoder":"named","tokens":["cut","wait"],"features":[["open"]]},)"
            R"({"name":"global","encoder":"own","tokens":["global"],"features":[["time"]]}],)"
            R"("actions":["cut","wait"]})");
}

TEST(ObservationSpec, RefusesOtherVersionsBeforeAnythingElse) {
  EXPECT_EQ(complaint(R"({"version":2,"shape":[]})"),
            "observations are of version 2 there, of version 1 here");
}

TEST(ObservationSpec, RefusesWhatNoObservationLooksLike) {
  EXPECT_EQ(complaint_with("\"human\"", "\"machines\""),
            "the observation's description has the group 'machines' twice");
  EXPECT_EQ(complaint_with("\"saw\"", "\"press\""),
            "group 2 of the observation's description has the token 'press' twice");
  EXPECT_EQ(complaint_with("\"heat\"", "\"busy\""),
            "group 2 of the observation's description has the feature 'busy' twice");
  EXPECT_EQ(complaint_with("[\"busy\"],", ""),
            "group 2 of the observation's description has 1 lists of features: it needs one for "
            "each token");
  EXPECT_EQ(complaint_with("\"shared\"", "\"mine\""),
            "group 1 of the observation's description has 'encoder': it must be 'shared', 'named' "
            "or 'own', not '\"mine\"'");
  EXPECT_EQ(complaint_with("\"actions\":[\"cut\"", "\"actions\":[\"weld\""),
            "the observation's description must have the group 'tasks', with a token for each "
            "action, last but one");
  EXPECT_EQ(complaint_with("\"name\":\"global\"", "\"name\":\"local\""),
            "the observation's description must end with the group 'global' of one token");
  EXPECT_EQ(complaint_with("\"name\":", "\"title\":"),
            "group 1 of the observation's description has the unknown key 'title'");
  EXPECT_EQ(complaint_with("\"open\"", "7"),
            "group 3 of the observation's description has an entry of 'features': it must hold "
            "texts only");
  EXPECT_EQ(complaint_with("\"open\"", "[]"), "the observation's description is nested too deeply");
  EXPECT_NE(complaint(""), "");
  EXPECT_NE(complaint("[]"), "");
  EXPECT_NE(complaint(to_json(sample()) + "x"), "");
}

TEST(ObservationSpec, RefusesMoreThanALineCanHave) {
  std::string tokens = "\"h0\"";
  for (int i = 1; i < 5000; ++i) tokens += ",\"h" + std::to_string(i) + "\"";
  EXPECT_EQ(complaint_with("\"h0\",\"h1\"", tokens),
            "the observation's description has more than 4096 tokens");
}

std::string mismatch(const std::function<void(ObservationSpec&)>& change) {
  ObservationSpec line = sample();
  change(line);
  return explain_mismatch(sample(), line);
}

TEST(ObservationSpec, MismatchNamesTheFirstDifference) {
  EXPECT_EQ(mismatch([](auto&) {}), "");
  EXPECT_EQ(mismatch([](auto& s) { s.version = 2; }),
            "observations are of version 1 for the policy, of version 2 for the line");
  EXPECT_EQ(mismatch([](auto& s) { s.groups[0].name = "robot"; }),
            "the line has group 'robot', the policy has not");
  EXPECT_EQ(mismatch([](auto& s) { s.groups.erase(s.groups.begin()); }),
            "the policy has group 'human', the line has not");
  EXPECT_EQ(mismatch([](auto& s) { std::swap(s.groups[0], s.groups[1]); }),
            "group 1 is 'machines' on the line, 'human' for the policy");
  EXPECT_EQ(mismatch([](auto& s) { s.groups[1].tokens[1] = "oven"; }),
            "the line has machine 'oven', the policy has not");
  EXPECT_EQ(mismatch([](auto& s) {
              s.groups[1].tokens.pop_back();
              s.groups[1].features.pop_back();
            }),
            "the policy has machine 'press', the line has not");
  EXPECT_EQ(mismatch([](auto& s) { s.groups[1].features[1][1] = "force"; }),
            "the line has number 'force' of machine 'press', the policy has not");
  EXPECT_EQ(mismatch([](auto& s) { std::swap(s.groups[2].tokens[0], s.groups[2].tokens[1]); }),
            "task 1 is 'wait' on the line, 'cut' for the policy");
  EXPECT_EQ(mismatch([](auto& s) { s.groups[2].encoder = Encoder::kShared; }),
            "'tasks' are interchangeable on the line and alike but named for the policy");
  EXPECT_EQ(mismatch([](auto& s) { s.actions.pop_back(); }),
            "the policy has action 'wait', the line has not");
}

TEST(ObservationSpec, NamesOfInterchangeableTokensAreNoMismatch) {
  EXPECT_EQ(mismatch([](auto& s) { s.groups[0].tokens = {"Ann", "Bob"}; }), "");
  EXPECT_EQ(mismatch([](auto& s) { s.groups[0].tokens.push_back("h2"); }),
            "the line has room for 3 of 'human', the policy for 2");
}

}  // namespace
}  // namespace linewright
