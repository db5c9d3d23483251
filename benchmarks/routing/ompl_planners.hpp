#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cases.hpp"

namespace linewright::bench {

/// Names of the planners of OMPL that are compared; none where it was not installed at
/// configuration.
[[nodiscard]] std::vector<std::string> ompl_planners();

/// Length of what a planner finds on a case's map within so many seconds of CPU, with the same
/// footprint and clearance, motions looked at every 5 cm; planners that stop at the first path use
/// the rest to shorten it. None: nothing found.
[[nodiscard]] std::optional<double> ompl_path_m(const std::string& planner, const Case& c,
                                                const Query& query, double seconds);

/// Lengths of the Reeds-Shepp curves of pairs. False: no OMPL.
[[nodiscard]] bool ompl_lengths_m(const std::vector<Query>& pairs, double radius_m,
                                  std::vector<double>& lengths);

}  // namespace linewright::bench
