#pragma once

#include <optional>

#include "line_net.hpp"
#include "linewright/line/lower_limits.hpp"

namespace linewright::bounds {

/// The rule that the limit makes: that it holds at the end of a tick; none where the net has no
/// such event.
[[nodiscard]] std::optional<Arc> arc_for(const LineNet& net, const LowerLimit& limit);

}  // namespace linewright::bounds
