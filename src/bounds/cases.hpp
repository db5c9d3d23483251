#pragma once

#include <vector>

#include "line_net.hpp"

namespace linewright::bounds {

/// Least times of all runs that share the tokens of the line's forks in a certain way: so many of
/// each went this way, so many that way. Every run that finishes belongs to at least one case.
struct Case {
  Times times;
  Tick ends = 1;  ///< of the critical path
};

/// All cases in which the order can be finished, by their critical paths; a single one, the whole,
/// when there would be too many. At least one.
[[nodiscard]] std::vector<Case> cases_of(const LineNet& net, const Times& times);

}  // namespace linewright::bounds
