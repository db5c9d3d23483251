#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "linewright/base/id.hpp"

namespace linewright {

/// Most members (workers and carriers) a task's crew may have.
inline constexpr std::size_t kMaxCrew = 8;

/// A decision made complete: the task and who does it. `members[i]` is the WorkerId or CarrierId
/// value for crew slot i of the task; kNobody for a slot that joins late and for unused entries.
struct Assignment {
  static constexpr std::int16_t kNobody = -1;

  TaskId task;
  std::array<std::int16_t, kMaxCrew> members{};

  Assignment() { members.fill(kNobody); }
  explicit Assignment(TaskId t) : task(t) { members.fill(kNobody); }
};

}  // namespace linewright
