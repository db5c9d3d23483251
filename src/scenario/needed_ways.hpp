#pragma once

#include <cstddef>
#include <vector>

#include "linewright/line/line_model.hpp"

namespace linewright::loading {

/// Stations between which the workers of one kind may have to move: from each of `from` to each of
/// `to`. Both are in station order.
struct NeededWays {
  std::vector<StationId> from;  ///< where they start, are sent or rest
  std::vector<StationId> to;    ///< where tasks send them and where they rest
};

[[nodiscard]] NeededWays needed_ways(const LineModel& line, WorkerKindId kind);

/// Where things of a kind that starts at `start` (or anywhere, if empty) can stand at the start.
[[nodiscard]] std::vector<StationId> start_stations(const LineModel& line, WorkerKindId kind,
                                                    const std::vector<StationId>& start);

}  // namespace linewright::loading
