#include "linewright/network/policy_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>

#include "linewright/base/diagnostic.hpp"
#include "small_spec.hpp"

namespace linewright {
namespace {

Policy sample() {
  Policy policy;
  policy.spec = testing_network::small_spec();
  policy.options.width = 16;
  policy.options.feedforward = 8;
  policy.options.head_hidden = 8;
  policy.metadata = {{"line", "duct line"}, {"steps", "1000"}};
  policy.tensors = initial_tensors(policy.spec, policy.options, 3);
  return policy;
}

class PolicyFile : public testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove_all(folder_); }

  [[nodiscard]] std::string path() const { return folder_ + "/agent.safetensors"; }

  /// What loading says once `change` was done to the file.
  std::string complaint_after(const std::function<void(TensorFile&)>& change) const {
    save_policy(path(), sample());
    TensorFile contents = read_safetensors(path());
    change(contents);
    try {
      static_cast<void>(parse_policy(to_safetensors(contents), "p"));
      return "";
    } catch (const ScenarioError& error) {
      return error.what();
    }
  }

 private:
  std::string folder_ = testing::TempDir() + "policy_file_test_" +
                        testing::UnitTest::GetInstance()->current_test_info()->name();
};

TEST_F(PolicyFile, ComesBackAsItWas) {
  save_policy(path(), sample());
  EXPECT_EQ(load_policy(path()), sample());
  static_cast<void>(load_policy(path()).network());
}

TEST_F(PolicyFile, SaysWhatIsNoPolicy) {
  EXPECT_EQ(complaint_after([](TensorFile& f) { f.metadata.erase("linewright.policy"); }),
            "p: error: its metadata lack 'linewright.policy': this is no policy\n"
            "  hint: name a file that `linewright train` has written");
  EXPECT_EQ(complaint_after([](TensorFile& f) { f.metadata["linewright.policy"] = "2"; }),
            "p: error: the policy is of format version '2', this program reads 1\n"
            "  hint: use the version of Linewright that wrote it");
}

TEST_F(PolicyFile, SaysThatObservationsHaveChanged) {
  EXPECT_EQ(complaint_after([](TensorFile& f) {
              std::string& spec = f.metadata["linewright.observation"];
              spec.replace(spec.find("\"version\":1"), 11, "\"version\":9");
            }),
            "p: error: observations are of version 9 there, of version 1 here\n"
            "  hint: train the policy again with this version of Linewright");
}

TEST_F(PolicyFile, RefusesTensorsThatDoNotFit) {
  const std::string found =
      complaint_after([](TensorFile& f) { f.tensors.erase("value.out.bias"); });
  EXPECT_NE(found.find("the tensor 'value.out.bias' [1] is missing"), std::string::npos) << found;
  Policy policy = sample();
  policy.tensors.erase("value.out.bias");
  EXPECT_THROW(save_policy(path(), policy), ScenarioError);
  EXPECT_EQ(load_policy(path()), sample());  // the file of before
}

TEST_F(PolicyFile, RefusesMetadataUnderKeysOfTheFormat) {
  Policy policy = sample();
  policy.metadata["linewright.network"] = "mine";
  EXPECT_THROW(save_policy(path(), policy), ScenarioError);
}

TEST_F(PolicyFile, NamesTheFileThatIsNotThere) {
  try {
    static_cast<void>(load_policy(path()));
    FAIL();
  } catch (const ScenarioError& error) {
    EXPECT_EQ(error.diagnostics().front().file, path());
  }
}

}  // namespace
}  // namespace linewright
