#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "linewright/line/line_model.hpp"

namespace linewright::loading {

/// Where a machine can stand, found by following what the operations do with it.
struct MachineMotion {
  std::vector<bool> idle;  ///< by position: while nobody has it (homing included)
  std::vector<bool>
      held;  ///< by position: between the operation that claims and the one that frees it
};

[[nodiscard]] MachineMotion machine_motion(const LineModel& line, MachineId machine);

/// The positions whose travel times to another position may be asked for when an idle machine is
/// called: where it can stand, and between which a way home is interpolated.
[[nodiscard]] std::vector<bool> called_from(const Machine& machine, const MachineMotion& motion);

}  // namespace linewright::loading
