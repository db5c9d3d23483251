#pragma once

namespace linewright::bench {

// The sections of routing_benchmark. Each prints its tables. `thorough`: more queries, minutes
// instead of seconds.

void measure_hall(bool thorough);         ///< the duct line's tables: time, cache, quality
void measure_random_maps(bool thorough);  ///< single queries in random halls, and the tail
void compare_planners(bool thorough);     ///< beside OMPL and a textbook Hybrid A*
void compare_curves(bool thorough);       ///< Reeds-Shepp beside OMPL's
void compare_closing(bool thorough);      ///< heuristics when zones close

}  // namespace linewright::bench
