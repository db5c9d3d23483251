#pragma once

#include "shape.hpp"
#include "source_node.hpp"

namespace linewright::loading {

/// Reports everything in `root` that does not have `shape` and breaks it off, so that later passes
/// find only values of the right type. Numbers written per template value are picked here.
void check_shape(SourceNode& root, const Shape& shape, Problems& problems);

}  // namespace linewright::loading
