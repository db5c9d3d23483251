#pragma once

#include <cstddef>
#include <cstdint>

#include "linewright/base/tick.hpp"

// What a scenario may be at most. The limits are far beyond real lines; they keep every later sum
// and product within its type and every hostile file within bounded time and memory.
namespace linewright::loading {

inline constexpr std::size_t kMostEntries = 1000;        ///< per section, templates written out
inline constexpr std::size_t kMostKinds = 16;            ///< of workers; of carriers
inline constexpr std::size_t kMostStations = 400;        ///< travel tables grow with the square
inline constexpr std::size_t kMostPositions = 64;        ///< of one machine
inline constexpr std::size_t kMostSteps = 100;           ///< of one task
inline constexpr std::size_t kMostActions = 100;         ///< of one crew member in one step
inline constexpr std::size_t kMostReserves = 32;         ///< of one task; states keep a bit each
inline constexpr std::int32_t kMostExecutions = 30'000;  ///< max_running of all tasks together
inline constexpr std::int32_t kMostCrew = 8;             ///< slots of one task
inline constexpr std::int32_t kMostOfAKind = 10'000;     ///< workers or carriers of one kind
inline constexpr std::int32_t kLargestAmount = 1'000'000;
inline constexpr std::int32_t kMostPerOrder = 1000;     ///< N of `N*order`
inline constexpr double kLargestCoordinate = 1e5;       ///< metres
inline constexpr double kSmallestCell = 0.01;           ///< metres
inline constexpr double kShortestTick = 1e-3;           ///< seconds
inline constexpr std::size_t kMostCorners = 200;        ///< of an obstacle or a zone
inline constexpr std::size_t kMostOutlineCorners = 16;  ///< of a worker
inline constexpr double kMostRasterWork = 5e8;  ///< cells and edges to visit for all obstacles
inline constexpr std::size_t kLargestRouteCache = 256'000'000;  ///< bytes

}  // namespace linewright::loading
