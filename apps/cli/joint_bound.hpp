#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "linewright/bounds/lower_bounds.hpp"
#include "linewright/scenario/scenario.hpp"

namespace linewright::cli {

struct JointOptions {
  std::int64_t budget_ns = 0;      ///< per setup
  std::string python = "python3";  ///< the interpreter that has ortools
};

/// The bound of all resources at once, proven by CP-SAT in a Python of its own
/// (apps/solver/joint_bound.py). `found`: the makespan below which it looks for a run: `known`, or
/// what a short search of our own reaches.
struct JointBound {
  Bound bound;
  Tick found = 0;
};
/// Ctrl-C ends the proof; what is proven by then is the result. Throws ScenarioError when Python or
/// ortools is missing, or the solver fails.
[[nodiscard]] JointBound joint_bound(const Scenario& scenario, const RunSetup& setup,
                                     std::optional<Tick> known, const JointOptions& options);

}  // namespace linewright::cli
