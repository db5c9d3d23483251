#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "linewright/network/network.hpp"
#include "small_spec.hpp"

namespace linewright {
namespace {

using testing_network::small_spec;

std::string shape_of(const std::vector<TensorShape>& tensors, const std::string& name) {
  for (const TensorShape& tensor : tensors) {
    if (tensor.name == name) return shape_text(tensor.shape);
  }
  return "missing";
}

NetworkOptions wide_options() {
  return {.width = 64, .heads = 4, .feedforward = 128, .head_hidden = 64, .sigma0 = 0.5};
}

TEST(NetworkTensors, HaveTheShapesOfTheDocumentation) {
  const NetworkOptions options = wide_options();
  const auto tensors = expected_tensors(small_spec(), options);
  EXPECT_EQ(shape_of(tensors, "encoder.human.weight"), "[11, 64]");
  EXPECT_EQ(shape_of(tensors, "encoder.human.bias"), "[1, 64]");
  EXPECT_EQ(shape_of(tensors, "encoder.machines.weight"), "[38, 64]");
  EXPECT_EQ(shape_of(tensors, "encoder.machines.bias"), "[4, 64]");
  EXPECT_EQ(shape_of(tensors, "encoder.tasks.weight"), "[14, 64]");
  EXPECT_EQ(shape_of(tensors, "encoder.tasks.bias"), "[7, 64]");
  EXPECT_EQ(shape_of(tensors, "blocks.0.qkv.weight"), "[64, 192]");
  EXPECT_EQ(shape_of(tensors, "blocks.0.ff1.weight"), "[64, 128]");
  EXPECT_EQ(shape_of(tensors, "blocks.0.ff2.bias"), "[64]");
  EXPECT_EQ(shape_of(tensors, "blocks.1.qkv.weight"), "missing");
  EXPECT_EQ(shape_of(tensors, "cross.kv.weight"), "[64, 128]");
  EXPECT_EQ(shape_of(tensors, "cross.norm_out.weight"), "[64]");
  EXPECT_EQ(shape_of(tensors, "advantage.out.weight"), "[64, 1]");
  EXPECT_EQ(shape_of(tensors, "advantage.out.bias_sigma"), "[1]");
  EXPECT_EQ(shape_of(tensors, "value.hidden.weight_sigma"), "[64, 64]");
}

TEST(NetworkTensors, FollowTheOptions) {
  NetworkOptions options = wide_options();
  options.query = NetworkOptions::Query::kSingle;
  options.dueling = false;
  options.noisy = false;
  const auto tensors = expected_tensors(small_spec(), options);
  EXPECT_EQ(shape_of(tensors, "advantage.out.weight"), "[64, 7]");
  EXPECT_EQ(shape_of(tensors, "advantage.out.weight_sigma"), "missing");
  EXPECT_EQ(shape_of(tensors, "value.out.weight"), "missing");
}

TEST(NetworkTensors, StartAsDescribed) {
  const TensorMap tensors = initial_tensors(small_spec(), wide_options(), 1);
  const auto largest = [&](const char* name) {
    double most = 0.0;
    for (const float value : tensors.at(name).values)
      most = std::max(most, std::abs(double{value}));
    return most;
  };
  EXPECT_NEAR(largest("blocks.0.qkv.weight"), 1.0 / 8.0, 0.001);
  EXPECT_NEAR(largest("blocks.0.out.weight"), 1.0 / 16.0, 0.001);  // divided by sqrt(4)
  EXPECT_EQ(largest("blocks.0.qkv.bias"), 0.0);
  EXPECT_EQ(largest("encoder.human.bias"), 0.0);
  EXPECT_GT(largest("encoder.tasks.bias"), 0.1);
  EXPECT_EQ(largest("cross.norm_out.weight"), 1.0);
  EXPECT_EQ(tensors.at("value.hidden.weight_sigma").values.front(), 0.0625F);
}

TEST(NetworkTensors, DependOnTheSeedAlone) {
  EXPECT_EQ(initial_tensors(small_spec(), {}, 1), initial_tensors(small_spec(), {}, 1));
  EXPECT_NE(initial_tensors(small_spec(), {}, 1), initial_tensors(small_spec(), {}, 2));
}

}  // namespace
}  // namespace linewright
