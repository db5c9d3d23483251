#include "linewright/network/policy_file.hpp"

#include <fmt/format.h>

#include "linewright/base/diagnostic.hpp"
#include "packed_network.hpp"

namespace linewright {
namespace {

constexpr const char* kReserved = "linewright.";
constexpr const char* kFormat = "linewright.policy";
constexpr const char* kObservation = "linewright.observation";
constexpr const char* kNetwork = "linewright.network";
/// Raise it when files of before can no longer be read.
constexpr const char* kVersion = "1";

/// Takes the key out of the metadata.
std::string take(std::map<std::string, std::string>& metadata, const char* key,
                 const std::string& file) {
  const auto found = metadata.find(key);
  if (found == metadata.end()) {
    throw ScenarioError(file, fmt::format("its metadata lack '{}': this is no policy", key),
                        "name a file that `linewright train` has written");
  }
  std::string value = std::move(found->second);
  metadata.erase(found);
  return value;
}

Policy policy_of(TensorFile contents, const std::string& file) {
  Policy policy;
  const std::string version = take(contents.metadata, kFormat, file);
  if (version != kVersion) {
    throw ScenarioError(file,
                        fmt::format("the policy is of format version {}, this program reads {}",
                                    in_quotes(version), kVersion),
                        "use the version of Linewright that wrote it");
  }
  policy.spec = observation_spec_from_json(take(contents.metadata, kObservation, file), file);
  policy.options = network_options_from_json(take(contents.metadata, kNetwork, file), file);
  policy.metadata = std::move(contents.metadata);
  policy.tensors = std::move(contents.tensors);
  packed::check_tensors(policy.spec, policy.options, policy.tensors, file);
  return policy;
}

}  // namespace

Policy parse_policy(std::string_view bytes, const std::string& file) {
  return policy_of(parse_safetensors(bytes, file), file);
}

Policy load_policy(const std::string& path) { return policy_of(read_safetensors(path), path); }

void save_policy(const std::string& path, const Policy& policy) {
  check(policy.options, path);
  packed::check_tensors(policy.spec, policy.options, policy.tensors, path);
  for (const auto& [key, value] : policy.metadata) {
    if (!key.starts_with(kReserved)) continue;
    throw ScenarioError(path,
                        fmt::format("the metadata key {} belongs to the format", in_quotes(key)),
                        "choose another name");
  }
  TensorFile contents{policy.metadata, policy.tensors};
  contents.metadata[kFormat] = kVersion;
  contents.metadata[kObservation] = to_json(policy.spec);
  contents.metadata[kNetwork] = to_json(policy.options);
  write_safetensors(path, contents);
}

}  // namespace linewright
