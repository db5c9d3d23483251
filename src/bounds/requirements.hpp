#pragma once

#include <functional>
#include <vector>

#include "line_net.hpp"

namespace linewright::bounds {

/// What the tokens of a line cost in the least, by the weights of a linear program's dual: no flow
/// gives more than it takes and costs itself. So k tokens that arrive in a store have cost
/// k * weight in all, whichever way each of them went.
class Requirements {
 public:
  /// Follows the flows from which the goal can be reached.
  Requirements(const LineNet& net, int goal);

  /// The cost in one token of the goal when each firing of a flow costs `cost(flow index)`.
  [[nodiscard]] double cost_of_goal(const std::function<double(std::size_t)>& cost) const;
  /// The least ticks on any way of tokens from the store to the goal; kNever: there is none.
  [[nodiscard]] Tick way_to_goal(int store) const { return ways_[static_cast<std::size_t>(store)]; }

 private:
  const LineNet& net_;
  int goal_;
  std::vector<Tick> ways_;
  std::vector<int> main_give_;  ///< by flow: which of its `gives` carries all cost; -1: none
};

/// Rounds up, but for what comes from adding fractions.
[[nodiscard]] int rounded_up(double value);

}  // namespace linewright::bounds
