#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <vector>

#include "linewright/base/id.hpp"
#include "linewright/base/random.hpp"
#include "linewright/base/tick.hpp"
#include "linewright/line/line_model.hpp"

namespace linewright {

/// A zone that is closed for a while.
struct Closure {
  std::int32_t zone = 0;  ///< index into LineModel::zones
  Tick first = 1;
  Tick open = 2;  ///< the first tick in which it is open again

  friend auto operator<=>(const Closure&, const Closure&) = default;
};

/// What a caller fixes about a run; everything left open is the scenario's or drawn.
struct RunOptions {
  std::vector<std::optional<std::int32_t>>
      workers;  ///< by worker kind; may be shorter than the kinds
  std::optional<std::int32_t> order;
  std::optional<Tick> horizon;
  std::vector<Closure> closures;  ///< besides the scenario's; may overlap
};

/// The fixed facts of one run: who is there, where each starts, what is ordered.
struct RunSetup {
  std::vector<std::vector<StationId>> worker_start;   ///< [worker kind][i]
  std::vector<std::vector<StationId>> carrier_start;  ///< [carrier kind][i]
  std::int32_t order = 1;
  Tick horizon = 0;
  std::vector<Closure> closures;  ///< ascending by zone and time; those of one zone do not touch
};

/// Draws a setup: crew sizes where the scenario gives a range, and start stations without
/// replacement. The same seed gives the same setup whatever planner or allocator follows (common
/// random numbers). Throws ScenarioError when `options` asks for a crew or an order the line cannot
/// have.
[[nodiscard]] RunSetup sample_setup(const LineModel& line, const RunOptions& options,
                                    std::uint64_t seed);

/// In order, and what overlaps or touches put together, as RunSetup has them.
[[nodiscard]] std::vector<Closure> joined_closures(std::vector<Closure> closures);

/// The scenario's closures and `more` (which may overlap), put together as RunSetup has them.
[[nodiscard]] std::vector<Closure> all_closures(const LineModel& line, std::vector<Closure> more);

/// Throws ScenarioError when the order, the horizon, a closure or the number of workers or carriers
/// is one that no run of the line can have.
void check_setup(const LineModel& line, const RunSetup& setup);

}  // namespace linewright
