#pragma once

#include "linewright/experiments/experiment.hpp"

namespace linewright::experiments {

/// For people: what is measured, and in which unit.
[[nodiscard]] const char* title_of(Metric metric);

/// For axes.
[[nodiscard]] const char* short_title_of(Metric metric);

}  // namespace linewright::experiments
