#pragma once

#include "linewright/experiments/experiment.hpp"

namespace linewright::experiments {

/// For people: what is measured, and in which unit.
[[nodiscard]] const char* title_of(Metric metric);

/// For axes of charts.
[[nodiscard]] const char* short_title_of(Metric metric);

/// One word, for the spokes of a radar.
[[nodiscard]] const char* word_of(Metric metric);

}  // namespace linewright::experiments
