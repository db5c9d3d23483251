#include "linewright/network/network_options.hpp"

#include <gtest/gtest.h>

#include "linewright/base/diagnostic.hpp"

namespace linewright {
namespace {

std::string complaint(const std::string& json) {
  try {
    static_cast<void>(network_options_from_json(json, "t"));
    return "";
  } catch (const ScenarioError& error) {
    return error.what();
  }
}

TEST(NetworkOptions, ComeBackAsTheyWere) {
  NetworkOptions options;
  EXPECT_EQ(network_options_from_json(to_json(options), "t"), options);
  options = {.width = 96,
             .heads = 3,
             .encoder_layers = 2,
             .feedforward = 50,
             .head_hidden = 30,
             .query = NetworkOptions::Query::kSingle,
             .dueling = true,
             .noisy = false,
             .sigma0 = 0.1,
             .actor_critic = true};
  EXPECT_EQ(network_options_from_json(to_json(options), "t"), options);
  EXPECT_EQ(network_options_from_json("{}", "t"), NetworkOptions());
}

TEST(NetworkOptions, TextIsStable) {
  EXPECT_EQ(to_json(NetworkOptions()),
            R"({"width":32,"heads":2,"encoder_layers":1,"feedforward":64,"head_hidden":32,)"
            R"("query":"per_task","dueling":true,"noisy":true,"sigma0":0.1,"actor_critic":false})");
}

TEST(NetworkOptions, NameWhatIsImpossible) {
  EXPECT_EQ(complaint(R"({"width":31})"),
            "t: error: 'heads' of the network is 2, which does not divide 'width', 31\n"
            "  hint: each head takes an equal part of the width");
  EXPECT_EQ(complaint(R"({"width":0,"heads":0})"),
            "t: error: 'width' of the network is 0\n  hint: it must be from 1 to 1024\n"
            "t: error: 'heads' of the network is 0\n  hint: it must be from 1 to 64");
  EXPECT_EQ(complaint(R"({"actor_critic":true,"dueling":false})"),
            "t: error: 'actor_critic' of the network needs 'dueling'\n"
            "  hint: the value stream gives the value of the state");
  NetworkOptions options;
  options.sigma0 = -0.5;
  EXPECT_THROW(check(options, "t"), ScenarioError);
  options.sigma0 = 0.0 / 0.0;
  EXPECT_THROW(check(options, "t"), ScenarioError);
}

TEST(NetworkOptions, RefuseOtherJson) {
  EXPECT_EQ(complaint(R"({"widht":64})"),
            "t: error: the network's options has the unknown key 'widht'\n"
            "  hint: did you mean 'width'?");
  EXPECT_NE(complaint(R"({"width":"64"})"), "");
  EXPECT_NE(complaint(R"({"width":64.5})"), "");
  EXPECT_NE(complaint(R"({"width":99999999999999999999})"), "");
  EXPECT_NE(complaint(R"({"query":"all"})"), "");
  EXPECT_NE(complaint(R"({"noisy":1})"), "");
  EXPECT_NE(complaint(R"({"sigma0":1e999})"), "");
  EXPECT_NE(complaint(R"({"width":64,"width":64})"), "");
  EXPECT_NE(complaint("[]"), "");
  EXPECT_NE(complaint(""), "");
}

}  // namespace
}  // namespace linewright
