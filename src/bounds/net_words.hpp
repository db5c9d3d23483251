#pragma once

#include <utility>
#include <vector>

#include "linewright/line/resources.hpp"

namespace linewright::bounds {

/// How the operation uses the machine; none: it is not among them.
[[nodiscard]] const MachineUse* find(const std::vector<MachineUse>& uses, MachineId machine);

/// Tokens of the store among (store, tokens).
[[nodiscard]] int tokens_in(const std::vector<std::pair<int, int>>& flows, int store);

}  // namespace linewright::bounds
