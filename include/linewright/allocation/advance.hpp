#pragma once

#include "linewright/allocation/allocator.hpp"
#include "linewright/simulation/simulator.hpp"

namespace linewright {

/// Lets the allocator bind the late joiner that can be bound now (status kJoin). Throws
/// std::logic_error when an allocator breaks its contract and names nobody.
void bind_joiner(const Simulator& simulator, SimulationState& state, Allocator& allocator,
                 EventLog* log = nullptr);

/// Goes on until a decision is due or the run has ended, binding late joiners on the way.
RunStatus advance_and_join(const Simulator& simulator, SimulationState& state, Allocator& allocator,
                           EventLog* log = nullptr);

}  // namespace linewright
