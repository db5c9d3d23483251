#pragma once

#include <cstdint>
#include <string>

namespace linewright {

/// The shape of the high-level agent's network (network.hpp). Together with the ObservationSpec it
/// decides which tensors there are; a policy file carries both.
struct NetworkOptions {
  /// What asks the memory of the encoder (paper, Sec. 3.3.5).
  enum class Query : std::uint8_t {
    kPerTask,  ///< each task on its own: one value per query
    kSingle,   ///< the mean of the tasks, once: all values come out of one query
  };

  /// Numbers per token, 1 to 1024, `heads` times a whole number. Time grows with its square.
  int width = 32;
  /// Attention heads, 1 to 64. Fastest where width / heads is a multiple of 16.
  int heads = 2;
  /// Self-attention blocks over all tokens, 0 to 8. Time grows in proportion.
  int encoder_layers = 1;
  /// Hidden numbers of the feedforward parts, 1 to 4096. Time grows in proportion.
  int feedforward = 64;
  /// Hidden numbers of the advantage and the value stream, 1 to 4096.
  int head_hidden = 32;
  Query query = Query::kPerTask;
  /// Q = value + advantage - mean advantage; otherwise there is no value stream.
  bool dueling = true;
  /// The last layers explore by learned noise (Fortunato et al.): twice the numbers in them.
  bool noisy = true;
  /// Noise at the start, 0 to 10: deviations are sigma0 / sqrt(inputs). Of use with `noisy` only.
  double sigma0 = 0.1;
  /// Gives logits and a state value instead of Q values; needs `dueling`, for the value stream.
  bool actor_critic = false;

  friend bool operator==(const NetworkOptions&, const NetworkOptions&) = default;
};

/// Throws ScenarioError naming `file` and every field that is out of range or does not fit another.
void check(const NetworkOptions& options, const std::string& file);

/// The options as JSON (compact, keys in the order of the fields, "per_task" and "single"), for the
/// metadata of a policy file.
[[nodiscard]] std::string to_json(const NetworkOptions& options);

/// Reads what to_json wrote; absent keys keep their defaults. Throws ScenarioError (naming `file`)
/// for anything else: unknown keys, wrong types, impossible sizes.
[[nodiscard]] NetworkOptions network_options_from_json(const std::string& json,
                                                       const std::string& file);

}  // namespace linewright
