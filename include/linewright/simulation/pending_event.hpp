#pragma once

#include <cstdint>

#include "linewright/simulation/state.hpp"

namespace linewright {

// The order of events within one tick: zones close and open, late joiners start, workers by number,
// operations in file order, recoveries in file order, who has nothing to do leaves to rest
// (docs/formats/scenario.md, Semantics 2). The number of what it is about is in the lower half.
inline constexpr std::uint32_t kZoneEvent = 0;
inline constexpr std::uint32_t kStartOfRun = 1U << 16;
inline constexpr std::uint32_t kJoinEvent = 2U << 16;
inline constexpr std::uint32_t kWorkerEvent = 3U << 16;
inline constexpr std::uint32_t kOperationEvent = 4U << 16;
inline constexpr std::uint32_t kRecoveryEvent = 5U << 16;
inline constexpr std::uint32_t kRestEvent = 6U << 16;
inline constexpr std::uint32_t kEventNumber = 0xffff;

/// What an event of SimulationState::events is: one of the constants above.
[[nodiscard]] inline std::uint32_t kind_of(const SimulationState::Event& event) {
  return event.order() & ~kEventNumber;
}

/// The id of the zone, worker or operation that it is about.
[[nodiscard]] inline std::size_t number_of(const SimulationState::Event& event) {
  return event.order() & kEventNumber;
}

}  // namespace linewright
