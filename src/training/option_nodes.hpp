#pragma once

#include "linewright/scenario/problems.hpp"
#include "linewright/scenario/shape.hpp"
#include "linewright/scenario/source_node.hpp"
#include "linewright/training/training_options.hpp"

namespace linewright::training_files {

/// The shape of a whole options file, the files it extends merged into it.
[[nodiscard]] const loading::Shape& options_shape();

/// The options that a tree of that shape stands for; absent keys keep their defaults.
[[nodiscard]] TrainingOptions read_options(const loading::SourceNode& root);

/// Reports values that are sound by themselves but do not go together.
void check_together(const TrainingOptions& options, const loading::SourceNode& root,
                    loading::Problems& problems);

}  // namespace linewright::training_files
