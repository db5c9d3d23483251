#pragma once

#include <vector>

#include "line_net.hpp"

namespace linewright::bounds {

/// Where and when a machine that an operation has taken comes to rest.
struct Rest {
  std::int32_t position = -1;  ///< -1: not known
  Tick ticks = 0;              ///< from the end of the operation
  Tick recovery = 0;           ///< held so long after it has come to rest
};

/// One holding of a machine: by an operation that uses it, or from one that claims it to one that
/// frees it.
struct MachineJob {
  std::size_t operation = 0;  ///< that takes it; Flow of the same number
  std::int32_t from = -1;     ///< the position to which it travels first; -1: it does not
  Tick work = 0;              ///< of that operation, without travel
  std::vector<Rest> rests;    ///< the ways it can end
};

/// All holdings of the machine; empty where one cannot be told to be the end of another.
[[nodiscard]] std::vector<MachineJob> jobs_of(const LineNet& net, MachineId machine);

/// The least ticks from when the machine comes to rest until it is at `target` (-1: it need not
/// travel) for its next job, or for a later one.
[[nodiscard]] Tick setup_between(const LineNet& net, MachineId machine,
                                 const std::vector<MachineJob>& jobs, const Rest& rest,
                                 std::int32_t target);

}  // namespace linewright::bounds
