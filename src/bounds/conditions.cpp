#include "conditions.hpp"

namespace linewright::bounds {
std::optional<Arc> arc_for(const LineNet& net, const LowerLimit& limit) {
  const auto id = static_cast<std::size_t>(limit.variable.index);
  const Arc arc{.times = 0, .plus = limit.value};
  const auto with = [&](int event) {
    Arc made = arc;
    made.from = event;
    return made;
  };
  switch (limit.variable.kind) {
    case VariableKind::kPlaceCount:
    case VariableKind::kPlaceAvailable:
      if (!net.line.places[id].berth) return with(net.arrivals[id]);
      break;
    case VariableKind::kOperationDone:
      return with(net.ends[id]);
    case VariableKind::kTaskDone:
      if (id < net.tasks.size()) return with(net.tasks[id].end);
      break;
    default:
      break;
  }
  const bool berth = (limit.variable.kind == VariableKind::kPlaceCount ||
                      limit.variable.kind == VariableKind::kPlaceAvailable ||
                      limit.variable.kind == VariableKind::kPlaceRoom ||
                      limit.variable.kind == VariableKind::kPlaceOccupied) &&
                     net.line.places[id].berth;
  if (!berth) return std::nullopt;
  Arc made = with(net.parked[id]);  // something is in it only while a carrier stands there
  made.plus = 1;
  return made;
}

}  // namespace linewright::bounds
