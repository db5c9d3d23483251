#pragma once

#include <cstddef>
#include <vector>

#include "linewright/base/cancel.hpp"
#include "linewright/base/tick.hpp"
#include "linewright/experiments/cell.hpp"
#include "linewright/scenario/scenario.hpp"
#include "linewright/simulation/run_setup.hpp"

// The runs of a cell.
namespace linewright::experiments {

/// Of the files of a CellStore. Part of a cell's key, so that files of an older one are not read.
inline constexpr const char* kCellFormat = "linewright/cell/3";

/// Every crew of the scenario, with the cell's order and horizon.
[[nodiscard]] std::vector<RunOptions> crews_of(const ExperimentCell& cell,
                                               const Scenario& scenario);

/// The start of a trial, the same as in run_trials().
[[nodiscard]] RunSetup setup_of(const ExperimentCell& cell, const Scenario& scenario,
                                const RunOptions& crew, std::size_t trial);

/// The best lower bound of the makespan.
[[nodiscard]] Tick bound_of(const Scenario& scenario, const RunSetup& setup,
                            const CancelToken* cancel);

}  // namespace linewright::experiments
