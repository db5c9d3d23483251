#include "attention.hpp"

#include <gtest/gtest.h>

#include "attention_kernel.hpp"

namespace linewright::learning {
namespace {

using torch::Tensor;

struct Inputs {
  Tensor query, memory, present;
};

Inputs random_inputs(std::int64_t samples, std::int64_t queries, std::int64_t keys,
                     std::int64_t width) {
  torch::manual_seed(7);
  Inputs in{torch::randn({samples, queries, width}), torch::randn({samples, keys, 2 * width}),
            torch::rand({samples, keys}).gt(0.3).to(torch::kUInt8)};
  in.present.narrow(1, keys - 1, 1).fill_(1);  // someone is always there
  return in;
}

void expect_close(const Tensor& a, const Tensor& b, double tolerance) {
  EXPECT_LT((a - b).abs().max().item<double>(), tolerance);
}

class FusedAttentionTest : public ::testing::TestWithParam<std::pair<int, int>> {};

TEST_P(FusedAttentionTest, EqualsThePlainOperationsAndTheirGradients) {
  const auto [width, heads] = GetParam();
  const Inputs in = random_inputs(5, 9, 21, width);
  const Tensor direction = torch::randn({5, 9, width});
  const auto gradients = [&](auto&& operation) {
    Tensor query = in.query.clone().requires_grad_(true);
    Tensor memory = in.memory.clone().requires_grad_(true);
    const Tensor out = operation(query, memory);
    (out * direction).sum().backward();
    return std::vector<Tensor>{out.detach(), query.grad(), memory.grad()};
  };
  const auto fused = gradients(
      [&](const Tensor& q, const Tensor& m) { return attention(q, m, in.present, heads); });
  const auto plain = gradients(
      [&](const Tensor& q, const Tensor& m) { return plain_attention(q, m, in.present, heads); });
  for (std::size_t i = 0; i < fused.size(); ++i) expect_close(fused[i], plain[i], 2e-5);
}

INSTANTIATE_TEST_SUITE_P(Widths, FusedAttentionTest,
                         ::testing::Values(std::pair{16, 1}, std::pair{64, 4}, std::pair{24, 3},
                                           std::pair{40, 2}));

TEST(FusedAttention, OfOneTensorAsItsOwnMemoryHasTheSumOfTheGradients) {
  torch::manual_seed(3);
  const Tensor start = torch::randn({4, 13, 3 * 32});
  const Inputs in = random_inputs(4, 13, 13, 32);
  const Tensor direction = torch::randn({4, 13, 32});
  Tensor a = start.clone().requires_grad_(true);
  (self_attention(a, in.present, 2) * direction).sum().backward();
  Tensor b = start.clone().requires_grad_(true);
  (plain_attention(b.narrow(2, 0, 32).contiguous(), b.narrow(2, 32, 64), in.present, 2) * direction)
      .sum()
      .backward();
  expect_close(a.grad(), b.grad(), 2e-5);
}

TEST(FusedAttention, IgnoresAbsentKeys) {
  Inputs in = random_inputs(3, 4, 10, 32);
  const Tensor before = attention(in.query, in.memory, in.present, 4);
  in.memory.masked_fill_(in.present.eq(0).unsqueeze(2), 1e6F);
  EXPECT_TRUE(torch::equal(before, attention(in.query, in.memory, in.present, 4)));
}

TEST(AttentionKernels, OfAllInstructionSetsAgree) {
  const Inputs in = random_inputs(1, 9, 42, 64);
  const AttentionShape shape{.queries = 9, .keys = 42, .heads = 4, .head_width = 16};
  const auto run = [&](const AttentionKernels& kernels) {
    Tensor out = torch::zeros({9, 64});
    std::vector<float> weights(4 * 9 * 42);
    std::vector<float> scratch(scratch_size(shape));
    kernels.forward(shape, {in.query.data_ptr<float>(), 64}, {in.memory.data_ptr<float>(), 128},
                    {in.memory.data_ptr<float>() + 64, 128}, in.present.data_ptr<std::uint8_t>(),
                    weights.data(), {out.data_ptr<float>(), 64}, scratch.data());
    return out;
  };
  expect_close(run(attention_kernels()), run(plain_attention_kernels()), 1e-5);
}

}  // namespace
}  // namespace linewright::learning
