#include "kernels.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "linewright/base/random.hpp"

namespace linewright::kernels {
namespace {

std::vector<const Kernels*> sets() {
  std::vector<const Kernels*> result;
  for (const Kernels* set : available_kernels().sets) {
    if (set != nullptr) result.push_back(set);
  }
  return result;
}

std::vector<float> random_floats(RandomStream& random, std::size_t count) {
  std::vector<float> values(count);
  for (float& value : values) value = static_cast<float>(2.0 * random.uniform() - 1.0);
  return values;
}

/// The sum as kernels.hpp defines it.
float element(const Product& p, std::size_t row, std::size_t column) {
  const std::size_t block = column / kLanes;
  float sum = p.bias[row * p.bias_stride + column];
  for (std::size_t k = 0; k < p.depth; ++k) {
    const float w = p.w[block * p.w_block + k * p.w_stride + column % kLanes];
    sum = std::fma(p.x[row * p.x_stride + k], w, sum);
  }
  return sum;
}

TEST(Kernels, MultiplyExactlyAsDefined) {
  RandomStream random(1);
  for (const Kernels* set : sets()) {
    for (std::size_t rows = 1; rows <= 20; ++rows) {
      for (std::size_t blocks = 1; blocks <= 3; ++blocks) {
        const std::size_t depth = 1 + random.below(20);
        const std::size_t width = blocks * kLanes;
        const auto x = random_floats(random, rows * depth);
        const auto w = random_floats(random, depth * width);
        const auto bias = random_floats(random, rows * width);
        std::vector<float> y(rows * width);
        const Product product{.x = x.data(),
                              .x_stride = depth,
                              .rows = rows,
                              .depth = depth,
                              .w = w.data(),
                              .w_block = depth * kLanes,
                              .blocks = blocks,
                              .bias = bias.data(),
                              .bias_stride = width,
                              .y = y.data(),
                              .y_stride = width};
        set->multiply(product);
        for (std::size_t i = 0; i < rows * width; ++i) {
          ASSERT_EQ(y[i], element(product, i / width, i % width)) << set->name;
        }
      }
    }
  }
}

TEST(Kernels, AddAndCutTheProductsOff) {
  RandomStream random(2);
  const auto x = random_floats(random, 4);
  const auto w = random_floats(random, 4 * kLanes);
  const std::vector<float> zeros(kLanes, 0.0F);
  for (const Kernels* set : sets()) {
    std::vector<float> y(kLanes, 1.0F);
    Product product{.x = x.data(),
                    .x_stride = 4,
                    .rows = 1,
                    .depth = 4,
                    .w = w.data(),
                    .w_block = 4 * kLanes,
                    .blocks = 1,
                    .bias = zeros.data(),
                    .y = y.data(),
                    .y_stride = kLanes,
                    .then = Then::kAdd};
    set->multiply(product);
    for (std::size_t c = 0; c < kLanes; ++c) EXPECT_EQ(y[c], 1.0F + element(product, 0, c));
    product.then = Then::kRelu;
    set->multiply(product);
    for (std::size_t c = 0; c < kLanes; ++c)
      EXPECT_EQ(y[c], std::max(0.0F, element(product, 0, c)));
  }
}

TEST(Kernels, ExponentialIsExactToTwoInTenMillion) {
  for (const Kernels* set : sets()) {
    double worst = 0.0;
    for (double start = -87.0; start < 88.0; start += 0.01) {
      float x[kLanes];
      float y[kLanes];
      for (std::size_t i = 0; i < kLanes; ++i) {
        x[i] = static_cast<float>(std::min(88.0, start + 0.000613 * static_cast<double>(i)));
      }
      set->exponential(x, 1, y);
      for (std::size_t i = 0; i < kLanes; ++i) {
        const double exact = std::exp(double{x[i]});
        worst = std::max(worst, std::abs(y[i] - exact) / exact);
      }
    }
    EXPECT_LT(worst, 2e-7) << set->name;
  }
}

TEST(Kernels, ExponentialStaysFiniteFarOutside) {
  const float x[kLanes] = {-1e30F, -88.0F, 0.0F, 88.5F, 1e30F, -INFINITY, INFINITY};
  for (const Kernels* set : sets()) {
    float y[kLanes];
    set->exponential(x, 1, y);
    for (const float value : y) EXPECT_TRUE(std::isfinite(value) && value > 0.0F);
    EXPECT_EQ(y[2], 1.0F);
  }
}

TEST(Kernels, GiveTheSameBitsForNormsSharesAndNoise) {
  RandomStream random(3);
  for (std::size_t width = 1; width <= 70; ++width) {
    const std::size_t stride = padded(width);
    const auto x = random_floats(random, 3 * stride);
    const auto gain = random_floats(random, stride);
    const auto offset = random_floats(random, stride);
    std::vector<std::vector<float>> found;
    for (const Kernels* set : sets()) {
      std::vector<float> y(3 * stride);
      set->layer_norm({width, gain.data(), offset.data()}, x.data(), stride, 3, y.data());
      set->softmax(y.data(), stride, 3, stride / kLanes, 0.7F);
      std::vector<float> z(kLanes * 3);
      set->perturb(y.data(), x.data(), x.data(), gain.data(), 1, z.data());
      y.insert(y.end(), z.begin(), z.end());
      found.push_back(y);
    }
    for (const auto& y : found) ASSERT_EQ(y, found.front()) << width;
  }
}

TEST(Kernels, ThePlainSetIsAlwaysThere) {
  ASSERT_FALSE(sets().empty());
  EXPECT_EQ(sets().back(), &plain_kernels());
}

}  // namespace
}  // namespace linewright::kernels
