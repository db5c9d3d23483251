#include "linewright/allocation/advance.hpp"

#include <stdexcept>

namespace linewright {

void bind_joiner(const Simulator& simulator, SimulationState& state, Allocator& allocator,
                 EventLog* log) {
  const auto pending = simulator.pending_join(state);
  if (!pending || !simulator.join(state, *pending, allocator.join(state, *pending), log)) {
    throw std::logic_error("the allocator named nobody for a late joiner although one is free");
  }
}

RunStatus advance_and_join(const Simulator& simulator, SimulationState& state, Allocator& allocator,
                           EventLog* log) {
  while (simulator.advance(state, log) == RunStatus::kJoin) {
    bind_joiner(simulator, state, allocator, log);
  }
  return state.status;
}

}  // namespace linewright
