#pragma once

#include <cstdint>

#include "linewright/allocation/allocator.hpp"
#include "linewright/base/cancel.hpp"
#include "linewright/planning/planner.hpp"
#include "linewright/simulation/simulator.hpp"

namespace linewright {

/// Plays a run from `setup` to its end: the planner chooses the tasks, the allocator who does them;
/// both are reset with `seed` first. Returns how it ended; kRunning when `cancel` was requested
/// before.
RunStatus run_episode(const Simulator& simulator, SimulationState& state, const RunSetup& setup,
                      std::uint64_t seed, Planner& planner, Allocator& allocator,
                      EventLog* log = nullptr, const CancelToken* cancel = nullptr);

}  // namespace linewright
