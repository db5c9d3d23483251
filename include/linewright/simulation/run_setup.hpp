#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "linewright/base/id.hpp"
#include "linewright/base/random.hpp"
#include "linewright/base/tick.hpp"
#include "linewright/line/line_model.hpp"

namespace linewright {

/// What a caller fixes about a run; everything left open is the scenario's or drawn.
struct RunOptions {
  std::vector<std::optional<std::int32_t>>
      workers;  ///< by worker kind; may be shorter than the kinds
  std::optional<std::int32_t> order;
  std::optional<Tick> horizon;
};

/// The fixed facts of one run: who is there, where each starts, what is ordered.
struct RunSetup {
  std::vector<std::vector<StationId>> worker_start;   ///< [worker kind][i]
  std::vector<std::vector<StationId>> carrier_start;  ///< [carrier kind][i]
  std::int32_t order = 1;
  Tick horizon = 0;
};

/// Draws a setup: crew sizes where the scenario gives a range, and start stations without
/// replacement. The same seed gives the same setup whatever planner or allocator follows (common
/// random numbers). Throws ScenarioError when `options` asks for a crew or an order the line cannot
/// have.
[[nodiscard]] RunSetup sample_setup(const LineModel& line, const RunOptions& options,
                                    std::uint64_t seed);

/// Throws ScenarioError when the order, the horizon or the number of workers or carriers is one
/// that no run of the line can have.
void check_setup(const LineModel& line, const RunSetup& setup);

}  // namespace linewright
