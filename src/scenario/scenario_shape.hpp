#pragma once

#include "linewright/scenario/shape.hpp"

namespace linewright::loading {

/// The shape of a whole scenario file, templates written out.
[[nodiscard]] const Shape& scenario_shape();

}  // namespace linewright::loading
