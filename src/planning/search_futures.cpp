#include "search_futures.hpp"

#include <utility>

#include "linewright/allocation/advance.hpp"

namespace linewright::planning {

SearchedFutures search_futures(const Simulator& simulator, Allocator& allocator,
                               const SimulationState& start, const FutureSearch& search) {
  SearchedFutures found;
  std::vector<std::int32_t> scratch;
  std::vector<SimulationState> open{start};
  while (!open.empty()) {
    if (search.give_up && search.give_up()) return found;
    SimulationState state = std::move(open.back());
    open.pop_back();
    const RunStatus status = advance_and_join(simulator, state, allocator);
    if (status == RunStatus::kFinished) {
      found.finishes = true;
      return found;
    }
    if (status != RunStatus::kDecision) continue;
    const StateKey key = state_key(simulator, state, scratch);
    if (!found.seen.insert(key).second) continue;
    const std::optional<bool> known = search.known ? search.known(state, key) : std::nullopt;
    if (known == true) {
      found.finishes = true;
      return found;
    }
    if (known == false) continue;
    if (found.seen.size() > search.most) return found;
    if (!state.events.empty()) {  // waiting is tried last
      open.push_back(state);
      simulator.wait(open.back());
    }
    for (auto task = search.order.rbegin(); task != search.order.rend(); ++task) {
      if (!state.is_selectable(*task)) continue;
      open.push_back(state);
      simulator.assign(open.back(), allocator.allocate(state, *task));
    }
  }
  found.finishes = false;
  return found;
}

}  // namespace linewright::planning
