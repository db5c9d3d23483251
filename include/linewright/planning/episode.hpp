#pragma once

#include <cstdint>

#include "linewright/allocation/allocator.hpp"
#include "linewright/base/cancel.hpp"
#include "linewright/planning/planner.hpp"
#include "linewright/simulation/simulator.hpp"

namespace linewright {

/// Lets the allocator bind the late joiner that can be bound now (status kJoin). Throws
/// std::logic_error when an allocator breaks its contract and names nobody.
void bind_joiner(const Simulator& simulator, SimulationState& state, Allocator& allocator,
                 EventLog* log = nullptr);

/// Goes on until a decision is due or the run has ended, binding late joiners on the way.
RunStatus advance_and_join(const Simulator& simulator, SimulationState& state, Allocator& allocator,
                           EventLog* log = nullptr);

/// Plays a run from `setup` to its end: the planner chooses the tasks, the allocator who does them;
/// both are reset with `seed` first. Returns how it ended; kRunning when `cancel` was requested
/// before.
RunStatus run_episode(const Simulator& simulator, SimulationState& state, const RunSetup& setup,
                      std::uint64_t seed, Planner& planner, Allocator& allocator,
                      EventLog* log = nullptr, const CancelToken* cancel = nullptr);

}  // namespace linewright
