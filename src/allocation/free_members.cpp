#include "free_members.hpp"

#include <array>
#include <limits>

namespace linewright::allocation {
namespace {

std::size_t at(std::int16_t id) { return static_cast<std::size_t>(id); }

/// Empties the list; it then has room for `most` without allocating.
template <class List>
void start_over(List& list, std::size_t most) {
  list.clear();
  list.reserve(most);
}

}  // namespace

template <class Visit>
void FreeMembers::each_worker(const SimulationState& state, const Assignment& so_far,
                              std::size_t slot, Visit&& visit) const {
  const auto& crew = simulator_.line().tasks[so_far.task.index()].crew;
  std::array<std::int16_t, kMaxCrew> taken{};
  std::size_t count = 0;
  for (std::size_t other = 0; other < crew.size(); ++other) {
    if (other != slot && crew[other].worker && so_far.members[other] >= 0) {
      taken[count++] = so_far.members[other];
    }
  }
  const std::int32_t kind = crew[slot].worker->value;
  for (std::size_t w = 0; w < state.workers.size(); ++w) {
    if (!state.workers[w].free() || state.workers[w].kind != kind) continue;
    bool is_taken = false;
    for (std::size_t t = 0; t < count; ++t) is_taken |= taken[t] == static_cast<std::int16_t>(w);
    if (!is_taken) visit(w);
  }
}

const std::vector<Start>& FreeMembers::starts(const SimulationState& state,
                                              const Assignment& so_far, std::size_t slot,
                                              Standpoint standpoint) {
  start_over(starts_, state.workers.size());
  seen_.assign(simulator_.line().stations.size(), 0);
  each_worker(state, so_far, slot, [&](std::size_t w) {
    const bool snapped = standpoint == Standpoint::kSnapped;
    const bool single = !snapped && !simulator_.stands_at_station(state, WorkerId(w));
    const auto station = static_cast<std::int16_t>(
        snapped ? simulator_.snapped_station(state, WorkerId(w)).value : state.workers[w].station);
    if (!single && seen_[at(station)] != 0) return;
    if (!single) seen_[at(station)] = 1;
    starts_.push_back({static_cast<std::int16_t>(w), station});
  });
  return starts_;
}

const std::vector<Spot>& FreeMembers::spots(const SimulationState& state, TaskId task,
                                            std::size_t slot) {
  start_over(spots_, state.carriers.size());
  seen_.assign(simulator_.line().stations.size(), 0);
  const CrewSlot& wanted = simulator_.line().tasks[task.index()].crew[slot];
  for (std::size_t c = 0; c < state.carriers.size(); ++c) {
    const std::int16_t station = state.carriers[c].station;
    if (seen_[at(station)] != 0 || !simulator_.carrier_fits(state, wanted, CarrierId(c))) continue;
    seen_[at(station)] = 1;
    spots_.push_back({static_cast<std::int16_t>(c), station});
  }
  return spots_;
}

const std::vector<std::int16_t>& FreeMembers::workers(const SimulationState& state,
                                                      const Assignment& so_far, std::size_t slot) {
  start_over(workers_, state.workers.size());
  each_worker(state, so_far, slot,
              [&](std::size_t w) { workers_.push_back(static_cast<std::int16_t>(w)); });
  return workers_;
}

const std::vector<std::int16_t>& FreeMembers::carriers(const SimulationState& state, TaskId task,
                                                       std::size_t slot) {
  start_over(carriers_, state.carriers.size());
  const CrewSlot& wanted = simulator_.line().tasks[task.index()].crew[slot];
  for (std::size_t c = 0; c < state.carriers.size(); ++c) {
    if (simulator_.carrier_fits(state, wanted, CarrierId(c))) {
      carriers_.push_back(static_cast<std::int16_t>(c));
    }
  }
  return carriers_;
}

std::int16_t FreeMembers::first_carrier(const SimulationState& state, const Assignment& so_far,
                                        std::size_t slot) const {
  const auto& crew = simulator_.line().tasks[so_far.task.index()].crew;
  const auto fills_another = [&](std::int16_t carrier) {
    for (std::size_t other = 0; other < crew.size(); ++other) {
      if (other != slot && crew[other].carrier && so_far.members[other] == carrier) return true;
    }
    return false;
  };
  for (std::size_t c = 0; c < state.carriers.size(); ++c) {
    const auto carrier = static_cast<std::int16_t>(c);
    if (simulator_.carrier_fits(state, crew[slot], CarrierId(c)) && !fills_another(carrier)) {
      return carrier;
    }
  }
  return Assignment::kNobody;
}

}  // namespace linewright::allocation
