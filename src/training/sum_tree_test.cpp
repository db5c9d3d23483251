#include "linewright/training/sum_tree.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "linewright/base/random.hpp"

namespace linewright {
namespace {

std::vector<float> random_weights(std::size_t count, RandomStream& random) {
  std::vector<float> weights(count);
  for (float& weight : weights) {
    weight = random.below(3) == 0 ? 0.0F : static_cast<float>(random.uniform());
  }
  return weights;
}

/// The plain way: add up until the prefix is passed.
std::size_t plain_find(const std::vector<float>& weights, double prefix) {
  double sum = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    sum += static_cast<double>(weights[i]);
    if (sum > prefix) return i;
  }
  return weights.size();
}

TEST(SumTree, FindsWhatAddingUpFinds) {
  RandomStream random(1);
  for (const std::size_t count : {1, 2, 15, 16, 17, 255, 256, 257, 4096, 5000}) {
    SumTree tree(count);
    std::vector<float> weights(count);
    // Whole weights add up without rounding, so both must agree exactly, at the borders too.
    for (std::size_t i = 0; i < count; ++i) {
      weights[i] = static_cast<float>(random.below(4));
      tree.set(i, weights[i]);
    }
    weights[count / 2] = 5.0F;
    tree.set(count / 2, 5.0F);
    double sum = 0.0;
    for (const float weight : weights) sum += static_cast<double>(weight);
    ASSERT_EQ(tree.total(), sum) << count;
    for (double prefix = 0.0; prefix < sum; prefix += 0.5) {
      ASSERT_EQ(tree.find(prefix), plain_find(weights, prefix)) << count << " at " << prefix;
    }
  }
}

TEST(SumTree, NeverFindsALeafWithoutWeight) {
  RandomStream random(2);
  SumTree tree(1000);
  std::vector<float> weights = random_weights(1000, random);
  for (float& weight : weights) weight *= 1e-7F;
  weights[500] = 1e6F;  // the small ones vanish in the rounding of the sums
  tree.set_range(0, weights);
  for (int i = 0; i < 20'000; ++i) {
    const double prefix = random.uniform() * tree.total() * (i % 2 == 0 ? 1.0 : 1e-9);
    ASSERT_GT(tree[tree.find(prefix)], 0.0F);
  }
  for (const double beyond : {tree.total(), tree.total() * 2.0}) {
    EXPECT_GT(tree[tree.find(beyond)], 0.0F);
  }
}

TEST(SumTree, APrefixThatIsNoNumberStaysInside) {
  SumTree tree(100);
  EXPECT_LT(tree.find(1.0), 100U);  // nothing has a weight
  tree.set(70, 1.0F);
  EXPECT_EQ(tree.find(std::nan("")), 70U);
  EXPECT_EQ(tree.find(-1.0), 70U);
}

TEST(SumTree, OneLeafWithWeightIsAlwaysFound) {
  SumTree tree(300);
  tree.set(123, 0.5F);
  for (const double prefix : {0.0, 0.25, 0.5, 7.0}) EXPECT_EQ(tree.find(prefix), 123U);
}

TEST(SumTree, IsAFunctionOfItsLeavesAlone) {
  RandomStream random(3);
  constexpr std::size_t kCount = 5000;
  SumTree worn(kCount);
  std::vector<std::size_t> leaves;
  std::vector<float> values;
  for (int round = 0; round < 200; ++round) {
    leaves.clear();
    for (int i = 0; i < 64; ++i) leaves.push_back(random.below(kCount));
    values = random_weights(64, random);
    worn.set(leaves, values);
    worn.set(random.below(kCount), static_cast<float>(random.uniform()));
  }
  std::vector<float> weights(kCount);
  for (std::size_t i = 0; i < kCount; ++i) weights[i] = worn[i];
  SumTree fresh(kCount);
  fresh.set_range(0, weights);
  EXPECT_EQ(worn.total(), fresh.total());  // every bit
  for (int i = 0; i < 5000; ++i) {
    const double prefix = random.uniform() * fresh.total();
    ASSERT_EQ(worn.find(prefix), fresh.find(prefix));
  }
}

TEST(SumTree, FindsManyAtOnceLikeOneByOne) {
  RandomStream random(4);
  for (const std::size_t count : {1, 40, 5000}) {
    SumTree tree(count);
    tree.set_range(0, random_weights(count, random));
    tree.set(count / 2, 1.0F);
    std::vector<double> prefixes(1000);
    for (double& prefix : prefixes) prefix = random.uniform() * tree.total();
    std::vector<double> used = prefixes;
    std::vector<std::size_t> leaves(prefixes.size());
    tree.find(used, leaves);
    for (std::size_t i = 0; i < prefixes.size(); ++i) {
      ASSERT_EQ(leaves[i], tree.find(prefixes[i]));
    }
  }
}

TEST(SumTree, InABatchTheLastWeightOfALeafCounts) {
  SumTree tree(40);
  const std::vector<std::size_t> leaves{3, 39, 3};
  const std::vector<float> weights{1.0F, 2.0F, 4.0F};
  tree.set(leaves, weights);
  EXPECT_EQ(tree[3], 4.0F);
  EXPECT_EQ(tree.total(), 6.0);
}

TEST(SumTree, AnEmptyTreeHasNoWeight) {
  EXPECT_EQ(SumTree(0).total(), 0.0);
  EXPECT_EQ(SumTree(17).total(), 0.0);
}

}  // namespace
}  // namespace linewright
