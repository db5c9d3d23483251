#pragma once

#include <string>

#include "linewright/experiments/table.hpp"

// Numbers as people read them, the same in all formats.
namespace linewright::experiments {

/// Shares with three decimals; what is measured in training with as many as its size asks for;
/// everything else with one.
[[nodiscard]] std::string number_text(double value, Metric metric);

/// "783.1 ± 4.8", or both ends where the interval was cut off at what is possible, "0.973 (0.858 to
/// 1.000)"; the mean alone where the interval is too small to be seen; empty: there is no number.
/// `plus_minus`: what stands for the sign.
[[nodiscard]] std::string value_text(const TableValue& value, Metric metric,
                                     const std::string& plus_minus = " ± ");

[[nodiscard]] std::string paper_text(const TableValue& value, Metric metric);
[[nodiscard]] std::string ratio_text(const TableValue& value);

/// "3 seeds", "100 starts"; "1 start": there is no interval.
[[nodiscard]] std::string samples_text(const TableRow& row);

/// "over seeds", or for two kinds "over seeds and starts".
[[nodiscard]] std::string over_text(const JudgedClaim& claim);

/// A paragraph: how many runs, from which starts, with which training seeds, and what the intervals
/// are over.
[[nodiscard]] std::string what_was_run(const Experiment& experiment);

}  // namespace linewright::experiments
