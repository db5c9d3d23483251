#include "errand.hpp"

#include <variant>

namespace linewright::allocation {
namespace {

/// What the crew member does first that says where it has to be.
Errand first_errand(const Task& task, std::size_t slot) {
  Errand errand{.worker_slot = slot, .carrier_slot = std::nullopt, .goal = std::nullopt};
  for (const Step& step : task.steps) {
    for (const ActorSequence& sequence : step.sequences) {
      if (sequence.slot != slot) continue;
      for (const Action& action : sequence.actions) {
        if (const auto* fetch = std::get_if<FetchAction>(&action.what);
            fetch && !errand.carrier_slot) {
          errand.carrier_slot = fetch->carrier_slot;
        } else if (const auto* go = std::get_if<GoAction>(&action.what)) {
          errand.goal = go->station;
          return errand;
        }
      }
    }
  }
  return errand;
}

}  // namespace

std::vector<Errand> errands_of(const Task& task) {
  std::vector<Errand> errands;
  std::vector<bool> taken(task.crew.size(), false);
  for (std::size_t slot = 0; slot < task.crew.size(); ++slot) {
    if (!task.crew[slot].worker) continue;
    Errand errand = first_errand(task, slot);
    if (errand.carrier_slot && taken[*errand.carrier_slot]) errand.carrier_slot.reset();
    if (errand.carrier_slot) taken[*errand.carrier_slot] = true;
    errands.push_back(errand);
  }
  return errands;
}

}  // namespace linewright::allocation
