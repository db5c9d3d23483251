#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "linewright/base/id.hpp"
#include "linewright/line/task.hpp"

namespace linewright::allocation {

/// Crew slots that are filled together: a worker, maybe with the carrier it fetches.
struct Errand {
  std::size_t worker_slot = 0;
  std::optional<std::size_t> carrier_slot;
  std::optional<StationId>
      goal;  ///< where the worker goes first (with the carrier, if it fetches one)
};

/// The errands of a task, one per worker slot, in crew order. A carrier belongs to the first who
/// fetches it.
[[nodiscard]] std::vector<Errand> errands_of(const Task& task);

}  // namespace linewright::allocation
