#pragma once

#include <cstddef>
#include <new>
#include <string>
#include <vector>

#include "kernels.hpp"
#include "linewright/environment/observation_spec.hpp"
#include "linewright/network/network_options.hpp"
#include "linewright/network/safetensors.hpp"

// The weights as the kernels want them. Columns stand in blocks of kLanes, each block behind the
// other ([block][row][kLanes]), padded with zeros. The columns of each attention head fill whole
// blocks of their own.
namespace linewright::packed {

/// Memory that starts on a cache line.
template <class T>
struct Aligned {
  using value_type = T;
  static constexpr std::align_val_t kAlignment{64};

  Aligned() = default;
  template <class U>
  explicit Aligned(const Aligned<U>&) {}

  T* allocate(std::size_t count) {
    return static_cast<T*>(::operator new(count * sizeof(T), kAlignment));
  }
  void deallocate(T* memory, std::size_t) { ::operator delete(memory, kAlignment); }
  friend bool operator==(const Aligned&, const Aligned&) { return true; }
};

using Floats = std::vector<float, Aligned<float>>;

struct Linear {
  std::size_t depth = 0;   ///< rows of the weight
  std::size_t blocks = 0;  ///< of columns
  Floats weight;
  Floats bias;  ///< rows of `blocks` blocks: one, or one per token
};

struct Norm {
  std::size_t width = 0;
  Floats weight;
  Floats bias;

  [[nodiscard]] kernels::Norm view() const { return {width, weight.data(), bias.data()}; }
};

/// `sigma` is empty without noise.
struct Noisy {
  std::size_t inputs = 0;
  std::size_t outputs = 0;
  Linear mean;
  Linear sigma;
};

struct Feedforward {
  Linear first;
  Linear second;
};

struct Group {
  TokenGroup::Encoder encoder = TokenGroup::Encoder::kShared;
  bool always_present = false;        ///< the tasks
  std::vector<std::size_t> features;  ///< numbers of each token
  Linear linear;                      ///< depth: of all tokens together for kOwn
};

struct Block {
  Norm norm1;
  Linear qkv;
  Linear out;
  Norm norm2;
  Feedforward feedforward;
};

struct Cross {
  Norm norm_memory;
  Linear kv;
  Norm norm_query;
  Linear query;
  Linear out;
  Norm norm_feedforward;
  Feedforward feedforward;
  Norm norm_out;
};

struct Weights {
  std::vector<Group> groups;
  std::vector<Block> blocks;
  Cross cross;
  Noisy advantage_hidden;
  Noisy advantage_out;
  Noisy value_hidden;
  Noisy value_out;
};

/// Packs tensors whose names and shapes have been checked.
[[nodiscard]] Weights pack(const ObservationSpec& spec, const NetworkOptions& options,
                           const TensorMap& tensors);

/// Throws ScenarioError naming `file` and every tensor that is missing, superfluous, of another
/// shape than expected_tensors() says, or without the numbers its shape promises.
void check_tensors(const ObservationSpec& spec, const NetworkOptions& options,
                   const TensorMap& tensors, const std::string& file);

}  // namespace linewright::packed
