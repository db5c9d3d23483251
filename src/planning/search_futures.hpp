#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <unordered_set>
#include <vector>

#include "linewright/allocation/allocator.hpp"
#include "linewright/planning/state_key.hpp"
#include "linewright/simulation/simulator.hpp"

namespace linewright::planning {

/// What a search of the futures of a state found.
struct SearchedFutures {
  std::optional<bool> finishes;  ///< some future finishes the order, or none; none: not found out
  std::unordered_set<StateKey, StateKeyHash> seen;
};

/// How far it goes.
struct FutureSearch {
  const std::vector<TaskId>& order;  ///< all tasks: which is tried first
  std::size_t most = 0;              ///< states; more: not found out
  std::function<bool()> give_up;     ///< asked at every state; may be empty
  /// What is known of a state already, so that it need not be entered; may be empty.
  std::function<std::optional<bool>(const SimulationState&, const StateKey&)> known;
};

/// Depth first over decisions and waiting, which is tried last; agents by the allocator; a state
/// seen before is not entered again. The state's horizon counts.
[[nodiscard]] SearchedFutures search_futures(const Simulator& simulator, Allocator& allocator,
                                             const SimulationState& start,
                                             const FutureSearch& search);

}  // namespace linewright::planning
