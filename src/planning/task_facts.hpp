#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "linewright/base/id.hpp"
#include "linewright/line/line_model.hpp"

// What dispatching rules need to know about tasks, derived from the line model (rules.hpp).
namespace linewright::planning {

inline constexpr double kNowhere = std::numeric_limits<double>::infinity();

struct TaskFacts {
  double work = 0.0;           ///< ticks
  double tail = 0.0;           ///< ticks; kNowhere: what it delivers ends in no product
  double to_bottleneck = 0.0;  ///< ticks; kNowhere: it does not lead there
  std::vector<PlaceId> sources;
  std::vector<PlaceId> buffers;
};

struct LineFacts {
  std::vector<TaskFacts> tasks;
  /// By place: the shortest time in which an operation or a task takes something out; kNowhere:
  /// nothing does.
  std::vector<double> pace;
  std::optional<MachineId> bottleneck;  ///< none: the line has no machines
};

[[nodiscard]] LineFacts facts_of(const LineModel& line);

}  // namespace linewright::planning
