#pragma once

#include "linewright/scenario/source_node.hpp"

namespace linewright::loading {

/// Writes out the templates: takes `for` from `root` and makes every entry whose key contains a
/// variable exist once per value, the variable replaced in every text inside it.
void expand_templates(SourceNode& root, Problems& problems);

}  // namespace linewright::loading
