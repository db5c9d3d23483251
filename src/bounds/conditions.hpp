#pragma once

#include <optional>
#include <vector>

#include "line_net.hpp"

namespace linewright::bounds {

/// A condition cannot hold before the variable is at least this large.
struct LowerLimit {
  Variable variable;
  int value = 0;
};

/// What a condition asks for in any case: the comparisons of its only clause that are a lower limit
/// of one variable. Everything else it asks for is left out.
[[nodiscard]] std::vector<LowerLimit> lower_limits(const Condition& condition, int order);

/// The rule that the limit makes: that it holds at the end of a tick; none where the net has no
/// such event.
[[nodiscard]] std::optional<Arc> arc_for(const LineNet& net, const LowerLimit& limit);

}  // namespace linewright::bounds
