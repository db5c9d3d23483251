#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "linewright/base/cancel.hpp"
#include "linewright/base/tick.hpp"
#include "linewright/line/line_model.hpp"
#include "linewright/simulation/run_setup.hpp"

namespace linewright {

/// A tick before which no run of a setup can finish its order.
struct Bound {
  std::string name;      ///< short, unique within a report: `critical_path`, `machine:inner_gantry`
  Tick ticks = 1;        ///< >= 1; a run that finishes has this makespan or a larger one
  std::string argument;  ///< why, in a sentence that names this line's own places and numbers
};

struct BoundOptions {
  /// Most states that the sequencing of one resource keeps per number of units done; where there
  /// are more, some are merged. More: a higher bound where a kind has one worker (on the duct line
  /// some ticks for each doubling of a large order), in time in proportion; 0: without sequencing.
  std::size_t most_states = 10000;
};

/// Lower bounds of the makespan of one setup, the best first (ties: in the order of their kinds).
/// Valid for every planner and every allocator, with waiting and free choice of agents; the
/// horizon aside. Derived from the line alone (docs/bounds.md). Never empty. Deterministic.
/// A cancelled call returns the bounds that were complete. The setup must be one of the line.
[[nodiscard]] std::vector<Bound> lower_bounds(const LineModel& line, const RunSetup& setup,
                                              const BoundOptions& options = {},
                                              const CancelToken* cancel = nullptr);

/// (upper - lower) / lower: how far a makespan is from the bound (>= 1 tick), at most from the
/// best possible.
[[nodiscard]] double gap(Tick upper, Tick lower);

}  // namespace linewright
