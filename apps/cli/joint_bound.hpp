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
/// (apps/solver/joint_bound.py). It looks for runs that end before `known`, or before the best run
/// of a short search of our own (`found`; none: no run of it finished), else before the horizon.
struct JointBound {
  Bound bound;
  std::optional<Tick> found;
};
/// Ctrl-C ends the proof; what is proven by then is the result, none where that is nothing. Throws
/// ScenarioError when Python or ortools is missing, or the solver fails.
[[nodiscard]] std::optional<JointBound> joint_bound(const Scenario& scenario, const RunSetup& setup,
                                                    std::optional<Tick> known,
                                                    const JointOptions& options);

}  // namespace linewright::cli
