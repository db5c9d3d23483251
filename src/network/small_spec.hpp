#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "linewright/base/random.hpp"
#include "linewright/environment/observation_spec.hpp"
#include "linewright/network/network.hpp"

// Observations for tests: specs of any size and random states of them.
namespace linewright::testing_network {

inline std::vector<std::string> names(const std::string& stem, std::size_t count) {
  std::vector<std::string> result;
  for (std::size_t i = 0; i < count; ++i) result.push_back(fmt::format("{}{}", stem, i));
  return result;
}

/// Two groups of interchangeable workers, machines and materials of their own kinds, tasks by name
/// and one global token.
inline ObservationSpec make_spec(std::size_t workers, std::size_t machines, std::size_t materials,
                                 std::size_t tasks) {
  using Encoder = TokenGroup::Encoder;
  ObservationSpec spec;
  spec.groups.push_back({"human", Encoder::kShared, names("h", workers), {names("f", 11)}});
  spec.groups.push_back({"robot", Encoder::kShared, names("r", workers), {names("f", 9)}});
  TokenGroup own{"machines", Encoder::kOwn, names("m", machines), {}};
  for (std::size_t i = 0; i < machines; ++i) own.features.push_back(names("f", 8 + i % 7));
  spec.groups.push_back(own);
  spec.groups.push_back({"materials", Encoder::kNamed, names("p", materials), {names("f", 6)}});
  spec.groups.push_back({"tasks", Encoder::kNamed, names("t", tasks), {names("f", 14)}});
  spec.groups.push_back({"global", Encoder::kOwn, {"global"}, {names("f", 5)}});
  spec.actions = spec.groups[4].tokens;
  return spec;
}

/// 21 tokens, 7 of them tasks.
inline ObservationSpec small_spec() { return make_spec(3, 4, 3, 7); }

/// As large as a production line: 43 tokens, about 450 numbers, 9 actions.
inline ObservationSpec line_spec() { return make_spec(6, 12, 9, 9); }

struct State {
  std::vector<float> features;
  std::vector<std::uint8_t> present;
};

/// Features uniform in [-2, 2); a quarter of the tokens absent, with features 0, but all tasks
/// there.
inline State random_state(const ObservationSpec& spec, RandomStream& random) {
  State state;
  for (const TokenGroup& group : spec.groups) {
    for (std::size_t t = 0; t < group.tokens.size(); ++t) {
      const bool here = group.name == "tasks" || random.below(4) != 0;
      state.present.push_back(here ? 1 : 0);
      for (std::size_t i = 0; i < group.features_of(t).size(); ++i) {
        const auto number = static_cast<float>(4.0 * random.uniform() - 2.0);
        state.features.push_back(here ? number : 0.0F);
      }
    }
  }
  return state;
}

/// Tensors in which nothing is zero or one by chance, so that every one of them matters.
inline TensorMap random_tensors(const ObservationSpec& spec, const NetworkOptions& options,
                                std::uint64_t seed) {
  TensorMap tensors = initial_tensors(spec, options, seed);
  RandomStream random = RandomStream::derive(seed, "all tensors");
  for (auto& [name, tensor] : tensors) {
    for (float& value : tensor.values) value += static_cast<float>(0.2 * random.uniform() - 0.1);
  }
  return tensors;
}

}  // namespace linewright::testing_network
