#pragma once

#include <map>
#include <string>
#include <string_view>

#include "linewright/environment/observation_spec.hpp"
#include "linewright/network/network.hpp"
#include "linewright/network/network_options.hpp"
#include "linewright/network/safetensors.hpp"

namespace linewright {

/// A trained agent: what it sees, how its network is built, and the weights.
struct Policy {
  ObservationSpec spec;
  NetworkOptions options;
  /// Whatever else is worth keeping: the line's name and hash, the program's version, how it was
  /// trained. Keys starting with "linewright." belong to the file format.
  std::map<std::string, std::string> metadata;
  TensorMap tensors;

  /// The network, ready to run. Throws ScenarioError, naming `file`, when the tensors do not fit.
  [[nodiscard]] Network network(const std::string& file = "weights") const {
    return {spec, options, tensors, file};
  }

  friend bool operator==(const Policy&, const Policy&) = default;
};

/// Reads a policy file: safetensors with the metadata "linewright.policy" (version of the format,
/// "1"), "linewright.observation" and "linewright.network" (both JSON). The tensors have been
/// compared with both when this returns. Throws ScenarioError naming `path` for a file that is
/// something else, cut off, of another version or made for other observations.
[[nodiscard]] Policy load_policy(const std::string& path);

/// The same from bytes; `file` names them in messages.
[[nodiscard]] Policy parse_policy(std::string_view bytes, const std::string& file);

/// Writes the file, whole or not at all; the same policy gives the same bytes. Throws ScenarioError
/// naming `path` when the tensors do not fit, metadata takes a key of the format, or it cannot be
/// written.
void save_policy(const std::string& path, const Policy& policy);

}  // namespace linewright
