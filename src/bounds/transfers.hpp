#pragma once

#include <optional>

#include "line_net.hpp"

namespace linewright::bounds {

/// How many items there are in all for a transfer into a carrier of the task, event `item` being
/// that one of them has been moved, when an execution that leaves something behind must have filled
/// its carrier: all there will ever be lies there from the start, nothing else takes of it, and the
/// carrier comes empty. None: that is not so.
[[nodiscard]] std::optional<int> supply_loaded(const LineNet& net, const Task& task,
                                               const TransferAction& transfer, int item);

/// The task is chosen only while no more than so many tokens lie in the place, which it alone
/// fills, by `item`. None: that is not so.
[[nodiscard]] std::optional<int> most_when_chosen(const LineNet& net, const Task& task,
                                                  PlaceId place, int item);

}  // namespace linewright::bounds
