#pragma once

#include <cstddef>
#include <cstdint>

#include "kernels.hpp"
#include "linewright/network/network.hpp"
#include "packed_network.hpp"

namespace linewright::packed {

/// Sizes of a network. Strides are in floats and whole blocks.
struct Sizes {
  std::size_t tokens = 0;
  std::size_t actions = 0;
  std::size_t queries = 0;
  std::size_t heads = 0;
  std::size_t per_head = 0;
  std::size_t width = 0;         ///< stride of a token
  std::size_t heads_width = 0;   ///< stride of q, k or v
  std::size_t feedforward = 0;   ///< stride
  std::size_t hidden = 0;        ///< stride
  std::size_t outputs = 0;       ///< stride of the last layer of the advantages
  std::size_t plain_width = 0;   ///< `width` without padding
  float attention_scale = 0.0F;  ///< 1 / sqrt(per_head)

  Sizes(const ObservationSpec& spec, const NetworkOptions& options);
};

/// Places for everything between observation and output, each on a cache line.
struct Buffers {
  float* x = nullptr;            ///< tokens x width
  float* normed = nullptr;       ///< tokens x width
  float* qkv = nullptr;          ///< tokens x 3 heads_width; k and v of the memory
  float* keys = nullptr;         ///< k of a head, transposed: per_head x padded(tokens)
  float* scores = nullptr;       ///< tokens x padded(tokens)
  float* mask = nullptr;         ///< padded(tokens): 0 for a key, very low behind the last
  float* attended = nullptr;     ///< tokens x heads_width
  float* feedforward = nullptr;  ///< tokens x feedforward
  float* u = nullptr;            ///< queries x width
  float* queries = nullptr;      ///< queries x heads_width
  float* hidden = nullptr;       ///< queries x hidden
  float* outputs = nullptr;      ///< queries x outputs
  float* mean = nullptr;         ///< width: the mean of the queries
  float* weight = nullptr;       ///< a noisy layer's
  float* bias = nullptr;         ///< a noisy layer's
  float* noise = nullptr;        ///< outputs of a noisy layer
  float* zeros = nullptr;        ///< one head's

  /// Floats that all of them take.
  [[nodiscard]] static std::size_t size(const Sizes& sizes);
  /// Cuts `memory` (on a cache line) up.
  Buffers(const Sizes& sizes, float* memory);

 private:
  Buffers() = default;
  /// take(buffer, floats) for each of them.
  template <class Take>
  void for_each(const Sizes& sizes, const Take& take);
};

/// One state's way through the network.
class Pass {
 public:
  /// Keeps the references.
  Pass(const Sizes& sizes, const Weights& weights, const kernels::Kernels& kernels,
       const Buffers& buffers)
      : sizes_(sizes), weights_(weights), kernels_(kernels), buffers_(buffers) {}

  /// Encoders, blocks and cross-attention.
  void run(const float* features, const std::uint8_t* present);
  /// The heads, on what run() has left.
  void advantages(const Noise* noise, std::vector<float>& actions) const;
  [[nodiscard]] float value(const Noise* noise) const;

 private:
  void encode(const float* features, const std::uint8_t* present);
  void encode_alike(const Group& group, const float* features, const std::uint8_t* present);
  void encode_own(const Group& group, const float* features, const std::uint8_t* present);
  void linear(const Linear& layer, const float* x, std::size_t stride, std::size_t rows, float* y,
              kernels::Then then) const;
  void norm(const Norm& layer, const float* x, std::size_t rows) const;
  /// Into `attended`; q, k and v start with the first head.
  void attend(const float* q, std::size_t q_stride, std::size_t rows, const float* k,
              const float* v, std::size_t kv_stride) const;
  void transpose_keys(const float* k, std::size_t stride) const;
  void add_feedforward(const Norm& before, const Feedforward& layers, float* x,
                       std::size_t rows) const;
  void run_block(const Block& block) const;
  void cross() const;
  /// Mean of rows; the padding stays zero.
  void average(const float* rows, std::size_t count, float* mean) const;
  void noisy(const Noisy& layer, const LayerNoise* noise, const float* x, std::size_t stride,
             std::size_t rows, float* y, kernels::Then then) const;

  const Sizes& sizes_;
  const Weights& weights_;
  const kernels::Kernels& kernels_;
  Buffers buffers_;
  std::size_t rows_ = 0;   ///< tokens present
  std::size_t tasks_ = 0;  ///< row of the first task
};

}  // namespace linewright::packed
