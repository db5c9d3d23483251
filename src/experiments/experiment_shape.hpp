#pragma once

#include "linewright/scenario/shape.hpp"

namespace linewright::experiments {

/// What a file of an experiment may look like (docs/formats/experiment.md).
[[nodiscard]] const loading::Shape& experiment_shape();

}  // namespace linewright::experiments
