#pragma once

#include <nlohmann/json.hpp>

#include "linewright/bounds/joint_relaxation.hpp"

namespace linewright::cli {

/// What apps/solver/joint_bound.py reads.
[[nodiscard]] nlohmann::ordered_json to_json(const JointRelaxation& relaxation);

}  // namespace linewright::cli
