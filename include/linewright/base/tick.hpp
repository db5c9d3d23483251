#pragma once

#include <cstdint>

namespace linewright {

/// Simulated time: a whole number of time steps. The first tick of a run is 1; tick 0 is the state
/// before anything has happened. A scenario's `tick_s` says how many seconds one tick lasts.
using Tick = std::int32_t;

/// Largest duration or horizon a scenario may name; leaves room to add durations without overflow.
inline constexpr Tick kMaxTicks = 100'000'000;

}  // namespace linewright
