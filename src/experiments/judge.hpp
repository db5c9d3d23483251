#pragma once

#include "linewright/evaluation/statistics.hpp"
#include "linewright/experiments/table.hpp"

namespace linewright::experiments {

/// Several numbers of which a table shows the mean.
struct Sample {
  Spread spread;
  Sampled over = Sampled::kStarts;
};

/// The number of a table: the mean with its interval, which stays where numbers of `metric` can be.
[[nodiscard]] TableValue value_of(const Sample& sample, Metric metric);

[[nodiscard]] JudgedClaim judged(const Claim& claim, const Sample& lower, const Sample& than);

/// The row of this name; the loader has made sure that there is one.
[[nodiscard]] std::size_t row_named(const Experiment& experiment, const std::string& name);

}  // namespace linewright::experiments
