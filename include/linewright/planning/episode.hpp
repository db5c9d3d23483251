#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "linewright/allocation/allocator.hpp"
#include "linewright/base/cancel.hpp"
#include "linewright/planning/planner.hpp"
#include "linewright/simulation/simulator.hpp"

namespace linewright {

/// What else belongs to a run; all of it may be left out.
struct EpisodeOptions {
  EventLog* log = nullptr;
  const CancelToken* cancel = nullptr;
  /// With both: appends how many nanoseconds of this clock each decision took (the planner and,
  /// where it is asked, the allocator).
  std::function<std::int64_t()> now_ns;
  std::vector<std::int64_t>* decision_ns = nullptr;
};

/// Plays a run from `setup` to its end: the planner chooses the tasks, the allocator who does them
/// unless the planner does that, too; both are reset with `seed` first. Returns how it ended;
/// kRunning when the cancel token was requested before. Throws std::logic_error when a planner
/// breaks its contract.
RunStatus run_episode(const Simulator& simulator, SimulationState& state, const RunSetup& setup,
                      std::uint64_t seed, Planner& planner, Allocator& allocator,
                      const EpisodeOptions& options = {});

}  // namespace linewright
