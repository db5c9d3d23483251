#pragma once

#include <cstdint>
#include <vector>

#include "linewright/simulation/simulator.hpp"

namespace linewright {

/// A 128-bit fingerprint of what the future of a run depends on: marking, who does what, what is
/// under way, all times relative to now. Two states with equal keys have the same futures; totals,
/// serial numbers and the time of day do not enter.
struct StateKey {
  std::uint64_t high = 0;
  std::uint64_t low = 0;
  friend bool operator==(const StateKey&, const StateKey&) = default;
};

struct StateKeyHash {
  std::size_t operator()(const StateKey& key) const { return static_cast<std::size_t>(key.low); }
};

/// The key of a state of this line. `scratch` is working space, kept by the caller to save
/// allocations.
[[nodiscard]] StateKey state_key(const Simulator& simulator, const SimulationState& state,
                                 std::vector<std::int32_t>& scratch);

}  // namespace linewright
