#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "linewright/environment/observation_spec.hpp"
#include "linewright/network/network_options.hpp"
#include "linewright/network/noise.hpp"
#include "linewright/network/safetensors.hpp"

namespace linewright {

// The network: what it computes, and the name and shape of every tensor (paper, Sec. 3.3.5).
//
// Sizes: d = width, H = heads, e = d / H, L = encoder_layers, f = feedforward, h = head_hidden,
// T = tokens, A = actions. Vectors are rows. A layer `linear(x; p)` is x W + b with W = `p.weight`
// [in, out] (one row per input) and b = `p.bias` [out]. `LN(x; p)` is
// (x - mean) / sqrt(variance + 1e-5) * `p.weight` + `p.bias`, both [d], variance = mean square of
// the deviations (divided by d).
//
// A token is present where the observation says so; the tokens of the group "tasks" always are,
// whatever it says. What absent tokens hold influences nothing: they are left out of every sum.
//
// 1. Encoders. Token i of group g with features f_i becomes the row x_i = f_i W_i + b_i:
//      shared: W = `encoder.g.weight` [F, d] and b = `encoder.g.bias` [1, d], the same for all;
//      named:  W = `encoder.g.weight` [F, d]; b = row i of `encoder.g.bias` [tokens, d];
//      own:    `encoder.g.weight` [sum of F_i, d] holds the W_i one below the other, in the order
//              of the tokens; b = row i of `encoder.g.bias` [tokens, d].
//    F = features per token. A group without tokens has no tensors. X [T, d] is all rows, in the
//    order of the spec.
// 2. Blocks l = 0 .. L-1, with B = `blocks.l`:
//      h = LN(X; B.norm1);  (q k v) = linear(h; B.qkv)   weight [d, 3d], bias [3d]
//      X = X + linear(attention(q, k, v); B.out)         weight [d, d]
//      h = LN(X; B.norm2)
//      X = X + linear(relu(linear(h; B.ff1)); B.ff2)     weights [d, f] and [f, d]
//    attention: head a works on columns a e .. (a+1) e - 1 of q, k and v. Its output in these
//    columns is, for query i, the sum over present tokens j of p_ij v_j, with p_i = the softmax
//    over present j of (q_i . k_j) / sqrt(e).
// 3. Cross-attention of the queries U with the memory X:
//      per_task: U = the rows of X of the tokens of "tasks" [A, d]; single: U = their mean [1, d].
//      M = LN(X; cross.norm_memory);  (k v) = linear(M; cross.kv)   weight [d, 2d], bias [2d]
//      q = linear(LN(U; cross.norm_query); cross.query)             weight [d, d]
//      U = U + linear(attention(q, k, v); cross.out)                weight [d, d]
//      U = U + linear(relu(linear(LN(U; cross.norm_ff); cross.ff1)); cross.ff2)
//      U = LN(U; cross.norm_out)
// 4. Heads. `noisy(x; p)` is x (W + S * (n_in^T n_out)) + b + s * n_out with S = `p.weight_sigma`,
//    s = `p.bias_sigma` (shaped like W and b; there with option `noisy` only), * element by element
//    and n_in [in], n_out [out] the layer's noise; without noise it is linear(x; p).
//      advantages: g = relu(noisy(U; advantage.hidden))             weight [d, h]
//        per_task: a_i = noisy(g_i; advantage.out)                  weight [h, 1], bias [1]
//        single:   a = noisy(g; advantage.out)                      weight [h, A], bias [A]
//      value (`dueling` only; else there are no tensors `value...`): phi = mean of the rows of U,
//        v = noisy(relu(noisy(phi; value.hidden)); value.out)       weights [d, h] and [h, 1]
//      Q values: q_i = v + (a_i - mean of a) where `dueling`, else q_i = a_i.
//      `actor_critic`: logits are a, the state value is v.
//
// Arithmetic is float and gives the same bits on every machine: kernels.hpp says in which order.

/// A tensor that a network has.
struct TensorShape {
  std::string name;
  std::vector<std::int64_t> shape;
};

/// All tensors of a network, in the order above. Throws ScenarioError as Network does.
[[nodiscard]] std::vector<TensorShape> expected_tensors(const ObservationSpec& spec,
                                                        const NetworkOptions& options);

/// Weights to start learning from: uniform within 1/sqrt(inputs), those that end a residual branch
/// smaller by sqrt(2 (L + 1)); biases 0, but those of named and own tokens like their weights, so
/// that like tokens differ; LN weights 1; deviations sigma0/sqrt(inputs). The same seed gives the
/// same tensors on every platform.
[[nodiscard]] TensorMap initial_tensors(const ObservationSpec& spec, const NetworkOptions& options,
                                        std::uint64_t seed);

/// Scratch memory of forward(): one per thread, for any networks one after the other.
class Workspace {
 private:
  friend class Network;
  std::vector<float> memory_;
};

/// What the network makes of one state.
struct NetworkOutput {
  std::vector<float> actions;  ///< per action: its Q value, or its logit (`actor_critic`)
  float value = 0.0F;          ///< of the state; 0 where there is no value stream
};

/// A network, ready to run. Copies share the weights, which never change.
class Network {
 public:
  /// Checks names and shapes of all tensors and rearranges them for speed. Throws ScenarioError,
  /// naming `file`, for options that check() refuses, for a spec without its group "tasks" of one
  /// token per action, and for every tensor that is missing, superfluous or of another shape.
  Network(const ObservationSpec& spec, const NetworkOptions& options, const TensorMap& tensors,
          const std::string& file = "weights");

  /// One state: `features` is float[feature_count()], finite; `present` one byte per token. `noise`
  /// (from make_noise() of such a network) or null: none. Thread-safe with a workspace for each
  /// thread; allocates only when `workspace` or `output` first meets a network of this size.
  void forward(const float* features, const std::uint8_t* present, Workspace& workspace,
               const Noise* noise, NetworkOutput& output) const;

  /// Noise of the right size, all zero; without layers where the network is not noisy.
  [[nodiscard]] Noise make_noise() const;

  /// Names of the instruction sets that this machine can run, the fastest first. All give the same
  /// bits.
  [[nodiscard]] static std::vector<std::string> instruction_sets();
  /// Runs on that one (a name out of instruction_sets()) instead of the fastest, for tests and
  /// benchmarks.
  void use_instructions(const std::string& name);

 private:
  struct Parts;
  std::shared_ptr<const Parts> parts_;
  std::size_t instructions_ = 0;
};

}  // namespace linewright
