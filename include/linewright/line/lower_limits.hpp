#pragma once

#include <cstdint>
#include <vector>

#include "linewright/line/condition.hpp"

namespace linewright {

/// A condition cannot hold before the variable is at least this large (>= 1).
struct LowerLimit {
  Variable variable;
  std::int32_t value = 0;
};

/// What a condition asks for in any case: the comparisons of its only clause that are a lower limit
/// of one variable, the quantity ordered filled in. Everything else it asks for is left out.
[[nodiscard]] std::vector<LowerLimit> lower_limits(const Condition& condition, std::int32_t order);

}  // namespace linewright
