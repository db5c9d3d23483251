#pragma once

#include <optional>
#include <variant>

#include "linewright/line/line_model.hpp"

namespace linewright::loading {

/// Calls `visit(action, slot)` for every action of the task, step by step.
template <class Visit>
void for_each_action(const Task& task, const Visit& visit) {
  for (const Step& step : task.steps) {
    for (const ActorSequence& sequence : step.sequences) {
      for (const Action& action : sequence.actions) visit(action, sequence.slot);
    }
  }
}

/// Calls `visit(what)` for every action of type `What`.
template <class What, class Visit>
void for_each_action_of(const Task& task, const Visit& visit) {
  for_each_action(task, [&](const Action& action, std::size_t) {
    if (const auto* what = std::get_if<What>(&action.what)) visit(*what);
  });
}

/// Whether the task parks a carrier in the berth.
[[nodiscard]] inline bool parks_in(const Task& task, PlaceId berth) {
  bool found = false;
  for_each_action_of<ParkAction>(task,
                                 [&](const ParkAction& park) { found |= park.berth == berth; });
  return found;
}

}  // namespace linewright::loading
