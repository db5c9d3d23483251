#pragma once

#include <string>

#include "linewright/scenario/shape.hpp"
#include "linewright/scenario/source_node.hpp"

namespace linewright::loading {

/// Reports everything in `root` that does not have `shape` and breaks it off, so that later passes
/// find only values of the right type. Numbers written per template value are picked here.
/// `whole` is what messages call `root`.
void check_shape(SourceNode& root, const Shape& shape, Problems& problems,
                 const std::string& whole = "the scenario");

}  // namespace linewright::loading
