#include <algorithm>
#include <cmath>

#include "forward_pass.hpp"

namespace linewright::packed {

using kernels::padded;

Sizes::Sizes(const ObservationSpec& spec, const NetworkOptions& options)
    : tokens(spec.token_count()),
      actions(spec.actions.size()),
      heads(static_cast<std::size_t>(options.heads)),
      per_head(static_cast<std::size_t>(options.width / options.heads)),
      width(padded(static_cast<std::size_t>(options.width))),
      heads_width(heads * padded(per_head)),
      feedforward(padded(static_cast<std::size_t>(options.feedforward))),
      hidden(padded(static_cast<std::size_t>(options.head_hidden))),
      plain_width(static_cast<std::size_t>(options.width)),
      attention_scale(1.0F / std::sqrt(static_cast<float>(per_head))) {
  const bool single = options.query == NetworkOptions::Query::kSingle;
  queries = single ? 1 : actions;
  outputs = padded(single ? actions : 1);
}

template <class Take>
void Buffers::for_each(const Sizes& s, const Take& take) {
  const std::size_t keys_stride = padded(s.tokens);
  const std::size_t depth = std::max(s.width, s.hidden);
  const std::size_t columns = std::max(s.hidden, s.outputs);
  take(x, s.tokens * s.width);
  take(normed, s.tokens * s.width);
  take(qkv, s.tokens * 3 * s.heads_width);
  take(keys, s.per_head * keys_stride);
  take(scores, s.tokens * keys_stride);
  take(mask, keys_stride);
  take(attended, s.tokens * s.heads_width);
  take(feedforward, s.tokens * s.feedforward);
  take(u, s.queries * s.width);
  take(queries, s.queries * s.heads_width);
  take(hidden, s.queries * s.hidden);
  take(outputs, s.queries * s.outputs);
  take(mean, s.width);
  take(weight, depth * columns);
  take(bias, columns);
  take(noise, columns);
  take(zeros, padded(s.per_head));
}

std::size_t Buffers::size(const Sizes& sizes) {
  std::size_t sum = 0;
  Buffers().for_each(sizes, [&sum](float*&, std::size_t count) { sum += padded(count); });
  return sum;
}

Buffers::Buffers(const Sizes& sizes, float* memory) {
  for_each(sizes, [&memory](float*& buffer, std::size_t count) {
    buffer = memory;
    memory += padded(count);
  });
}

}  // namespace linewright::packed
