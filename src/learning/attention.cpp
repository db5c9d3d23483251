#include "attention.hpp"

#include <ATen/Parallel.h>

#include <cmath>
#include <limits>
#include <vector>

#include "attention_kernel.hpp"

namespace linewright::learning {
namespace {

using torch::Tensor;
using torch::autograd::AutogradContext;
using torch::autograd::variable_list;

std::size_t length(const Tensor& tensor, std::int64_t dimension) {
  return static_cast<std::size_t>(tensor.size(dimension));
}

AttentionShape shape_of(const Tensor& query, const Tensor& memory, std::int64_t width,
                        std::int64_t heads) {
  return {.queries = length(query, 1),
          .keys = length(memory, 1),
          .heads = static_cast<std::size_t>(heads),
          .head_width = static_cast<std::size_t>(width / heads)};
}

/// The rows of sample `b`, from column `column` on.
Rows rows(const Tensor& tensor, std::int64_t b, std::int64_t column) {
  return {tensor.data_ptr<float>() + b * tensor.stride(0) + column, length(tensor, 2)};
}
MutableRows mutable_rows(const Tensor& tensor, std::int64_t b, std::int64_t column) {
  return {tensor.data_ptr<float>() + b * tensor.stride(0) + column, length(tensor, 2)};
}

template <class Work>
void for_each_sample(std::int64_t samples, const AttentionShape& shape, Work&& work) {
  at::parallel_for(0, samples, 1, [&](std::int64_t begin, std::int64_t end) {
    std::vector<float> scratch(scratch_size(shape));
    for (std::int64_t b = begin; b < end; ++b) work(b, scratch.data());
  });
}

/// Queries stand in the first columns of `query`, keys and values in `memory` from column `keys`
/// on. For self-attention both are the same tensor.
class FusedAttention : public torch::autograd::Function<FusedAttention> {
 public:
  static Tensor forward(AutogradContext* context, const Tensor& query, const Tensor& memory,
                        const Tensor& present, std::int64_t heads) {
    const bool self = query.is_same(memory);
    const std::int64_t width = self ? query.size(2) / 3 : query.size(2);
    const std::int64_t keys = self ? width : 0;
    const AttentionShape shape = shape_of(query, memory, width, heads);
    const std::int64_t samples = query.size(0);
    Tensor out = torch::empty({samples, query.size(1), width}, query.options());
    Tensor weights = torch::empty({samples, heads, query.size(1), memory.size(1)}, query.options());
    for_each_sample(samples, shape, [&](std::int64_t b, float* scratch) {
      attention_kernels().forward(
          shape, rows(query, b, 0), rows(memory, b, keys), rows(memory, b, keys + width),
          present.data_ptr<std::uint8_t>() + b * present.stride(0),
          weights.data_ptr<float>() + b * weights.stride(0), mutable_rows(out, b, 0), scratch);
    });
    context->save_for_backward({query, memory, present, weights});
    context->saved_data["heads"] = heads;
    context->saved_data["self"] = self;
    return out;
  }

  static variable_list backward(AutogradContext* context, const variable_list& gradients) {
    const variable_list saved = context->get_saved_variables();
    const Tensor& query = saved[0];
    const Tensor& memory = saved[1];
    const Tensor& present = saved[2];
    const Tensor& weights = saved[3];
    const Tensor given = gradients[0].contiguous();
    const bool self = context->saved_data["self"].toBool();
    const std::int64_t heads = context->saved_data["heads"].toInt();
    const std::int64_t width = given.size(2);
    const std::int64_t keys = self ? width : 0;
    const AttentionShape shape = shape_of(query, memory, width, heads);
    const Tensor to_query = torch::empty_like(query);
    const Tensor to_memory = self ? to_query : torch::empty_like(memory);
    for_each_sample(given.size(0), shape, [&](std::int64_t b, float* scratch) {
      attention_kernels().backward(
          shape, rows(query, b, 0), rows(memory, b, keys), rows(memory, b, keys + width),
          present.data_ptr<std::uint8_t>() + b * present.stride(0),
          weights.data_ptr<float>() + b * weights.stride(0), rows(given, b, 0),
          mutable_rows(to_query, b, 0), mutable_rows(to_memory, b, keys),
          mutable_rows(to_memory, b, keys + width), scratch);
    });
    // For self-attention the one gradient counts once.
    return {to_query, self ? Tensor() : to_memory, Tensor(), Tensor()};
  }
};

Tensor split_heads(const Tensor& rows, std::int64_t heads) {
  return rows.view({rows.size(0), rows.size(1), heads, rows.size(2) / heads}).transpose(1, 2);
}

bool fusable(const Tensor& tensor) {
  return tensor.device().is_cpu() && tensor.scalar_type() == torch::kFloat32;
}

}  // namespace

Tensor plain_attention(const Tensor& query, const Tensor& memory, const Tensor& present,
                       std::int64_t heads) {
  const std::int64_t width = query.size(2);
  const Tensor q = split_heads(query, heads);
  const Tensor k = split_heads(memory.narrow(2, 0, width).contiguous(), heads);
  const Tensor v = split_heads(memory.narrow(2, width, width).contiguous(), heads);
  const double scale = 1.0 / std::sqrt(static_cast<double>(width / heads));
  const Tensor scores = torch::matmul(q, k.transpose(-2, -1)) * scale;
  const Tensor absent = present.eq(0).unsqueeze(1).unsqueeze(1);
  const Tensor weights =
      torch::softmax(scores.masked_fill(absent, -std::numeric_limits<float>::infinity()), -1);
  return torch::matmul(weights, v).transpose(1, 2).contiguous().view(query.sizes());
}

Tensor attention(const Tensor& query, const Tensor& memory, const Tensor& present,
                 std::int64_t heads) {
  if (!fusable(query)) return plain_attention(query, memory, present, heads);
  return FusedAttention::apply(query.contiguous(), memory.contiguous(), present.contiguous(),
                               heads);
}

Tensor self_attention(const Tensor& qkv, const Tensor& present, std::int64_t heads) {
  const std::int64_t width = qkv.size(2) / 3;
  if (!fusable(qkv)) {
    return plain_attention(qkv.narrow(2, 0, width).contiguous(), qkv.narrow(2, width, 2 * width),
                           present, heads);
  }
  const Tensor all = qkv.contiguous();
  return FusedAttention::apply(all, all, present.contiguous(), heads);
}

}  // namespace linewright::learning
