#pragma once

// The allocation rules written down plainly: every free worker, with every carrier, one after the
// other. What the allocators of src/allocation must choose as well, only faster; also the
// benchmark's yardstick.

#include <limits>
#include <optional>
#include <string_view>
#include <variant>
#include <vector>

#include "linewright/allocation/allocator.hpp"
#include "linewright/base/random.hpp"

namespace linewright::testing {

class PlainAllocator final : public Allocator {
 public:
  PlainAllocator(std::string_view rule, const Simulator& simulator)
      : simulator_(simulator),
        snapped_(rule == "sap_snapped"),
        first_(rule == "first_idle"),
        farthest_(rule == "longest_path"),
        random_choice_(rule == "no_spatial"),
        random_(0) {}

  void reset(std::uint64_t seed) override { random_ = RandomStream::derive(seed, "allocator"); }

  Assignment allocate(const SimulationState& state, TaskId task) override {
    Assignment assignment(task);
    const auto& crew = simulator_.line().tasks[task.index()].crew;
    std::vector<bool> fetched(crew.size(), false);
    for (std::size_t slot = 0; slot < crew.size(); ++slot) {
      if (!crew[slot].worker) continue;
      const Group group = group_of(task, slot, fetched);
      const std::optional<Candidate> best = choose(state, group, assignment);
      if (!best) continue;
      assignment.members[slot] = best->worker;
      if (group.carrier_slot) assignment.members[*group.carrier_slot] = best->carrier;
    }
    for (std::size_t slot = 0; slot < crew.size(); ++slot) {
      if (!crew[slot].carrier || assignment.members[slot] != Assignment::kNobody) continue;
      for (std::size_t c = state.carriers.size(); c-- > 0;) {
        if (simulator_.carrier_fits(state, crew[slot], CarrierId(c))) {
          assignment.members[slot] = static_cast<std::int16_t>(c);
        }
      }
    }
    return assignment;
  }

  WorkerId join(const SimulationState& state, PendingJoin pending) override {
    Assignment bound{TaskId(std::int32_t{state.executions[pending.execution].task})};
    bound.members = state.executions[pending.execution].members;
    const auto& crew = simulator_.line().tasks[bound.task.index()].crew;
    std::vector<bool> fetched(crew.size(), false);
    for (std::size_t slot = 0; slot < crew.size(); ++slot) {
      if (!crew[slot].worker) continue;
      const Group group = group_of(bound.task, slot, fetched);
      if (slot == pending.slot) {
        return WorkerId(std::int32_t{choose(state, group, bound).value_or(Candidate{}).worker});
      }
    }
    return WorkerId(-1);
  }

 private:
  struct Group {
    std::size_t slot = 0;
    std::optional<std::size_t> carrier_slot;
    std::optional<StationId> goal;
  };

  struct Candidate {
    std::int16_t worker = Assignment::kNobody;
    std::int16_t carrier = Assignment::kNobody;
    Leg way{0, 0.0};
    double straight_m = 0.0;
  };

  Group group_of(TaskId task, std::size_t slot, std::vector<bool>& fetched) const {
    Group group{.slot = slot, .carrier_slot = std::nullopt, .goal = std::nullopt};
    for (const Step& step : simulator_.line().tasks[task.index()].steps) {
      for (const ActorSequence& sequence : step.sequences) {
        if (sequence.slot != slot) continue;
        for (const Action& action : sequence.actions) {
          if (group.goal) continue;
          if (const auto* fetch = std::get_if<FetchAction>(&action.what)) {
            if (!group.carrier_slot) group.carrier_slot = fetch->carrier_slot;
          } else if (const auto* go = std::get_if<GoAction>(&action.what)) {
            group.goal = go->station;
          }
        }
      }
    }
    if (group.carrier_slot && fetched[*group.carrier_slot]) group.carrier_slot.reset();
    if (group.carrier_slot) fetched[*group.carrier_slot] = true;
    return group;
  }

  Point2 point(std::int32_t station, std::size_t kind) const {
    const Station& place = simulator_.line().stations[static_cast<std::size_t>(station)];
    return place.poses[kind].value_or(Pose2{}).point();
  }

  Leg way(const SimulationState& state, std::size_t w, StationId to) const {
    const WorkerState& worker = state.workers[w];
    if (!snapped_ || worker.arrive <= state.now) {
      return simulator_.route_from_worker(state, WorkerId(w), to);
    }
    const auto kind = static_cast<std::size_t>(worker.kind);
    const Point2 here = simulator_.worker_pose(state, WorkerId(w), state.now).point();
    std::optional<StationId> nearest;
    for (std::size_t s = 0; s < simulator_.line().stations.size(); ++s) {
      if (!simulator_.line().stations[s].poses[kind]) continue;
      const auto from_here = [&](StationId id) { return distance_m(here, point(id.value, kind)); };
      if (!nearest || from_here(StationId(s)) < from_here(*nearest)) nearest = StationId(s);
    }
    return simulator_.line().travel[kind].leg(*nearest, to);
  }

  Candidate candidate(const SimulationState& state, const Group& group, std::size_t worker,
                      std::int16_t carrier) const {
    Candidate made{.worker = static_cast<std::int16_t>(worker), .carrier = carrier};
    const auto kind = static_cast<std::size_t>(state.workers[worker].kind);
    if (carrier < 0) {
      if (group.goal) made.way = way(state, worker, *group.goal);
      return made;
    }
    const StationId stands(std::int32_t{state.carriers[static_cast<std::size_t>(carrier)].station});
    made.way = way(state, worker, stands);
    if (group.goal) {
      const Leg& onward = simulator_.line().travel[kind].leg(stands, *group.goal);
      made.way.ticks = made.way.ticks < 0 || onward.ticks < 0 ? -1 : made.way.ticks + onward.ticks;
      made.way.metres += onward.metres;
    }
    made.straight_m =
        distance_m(point(state.workers[worker].station, kind), point(stands.value, kind));
    return made;
  }

  /// Whether `a` is to be preferred to `b`, which came earlier (ties: the earlier one stays).
  bool better(const Candidate& a, const Candidate& b) const {
    if (first_) return a.carrier == b.carrier && a.straight_m < b.straight_m;
    if (a.way.ticks < 0 || b.way.ticks < 0) return a.way.ticks >= 0;
    if (farthest_) {
      return a.way.ticks != b.way.ticks ? a.way.ticks > b.way.ticks : a.way.metres > b.way.metres;
    }
    return a.way.ticks != b.way.ticks ? a.way.ticks < b.way.ticks : a.way.metres < b.way.metres;
  }

  template <class Visit>
  void each_pair(const SimulationState& state, const Group& group, const Assignment& so_far,
                 Visit&& visit) const {
    const auto& crew = simulator_.line().tasks[so_far.task.index()].crew;
    const auto each_worker = [&](std::int16_t carrier) {
      for (std::size_t w = 0; w < state.workers.size(); ++w) {
        const WorkerState& worker = state.workers[w];
        bool fits = worker.free() && worker.kind == crew[group.slot].worker->value;
        for (std::size_t other = 0; fits && other < crew.size(); ++other) {
          fits = other == group.slot || !crew[other].worker ||
                 so_far.members[other] != static_cast<std::int16_t>(w);
        }
        if (fits) visit(w, carrier);
      }
    };
    if (!group.carrier_slot) {
      each_worker(Assignment::kNobody);
    } else if (so_far.members[*group.carrier_slot] >= 0) {
      each_worker(so_far.members[*group.carrier_slot]);
    } else {
      for (std::size_t c = 0; c < state.carriers.size(); ++c) {
        if (simulator_.carrier_fits(state, crew[*group.carrier_slot], CarrierId(c))) {
          each_worker(static_cast<std::int16_t>(c));
        }
      }
    }
  }

  std::optional<Candidate> choose(const SimulationState& state, const Group& group,
                                  const Assignment& so_far) {
    if (random_choice_) return draw(state, group, so_far);
    std::optional<Candidate> best;
    each_pair(state, group, so_far, [&](std::size_t worker, std::int16_t carrier) {
      const Candidate made = candidate(state, group, worker, carrier);
      if (!best || better(made, *best)) best = made;
    });
    return best;
  }

  std::optional<Candidate> draw(const SimulationState& state, const Group& group,
                                const Assignment& so_far) {
    std::size_t count = 0;
    each_pair(state, group, so_far, [&](std::size_t, std::int16_t) { ++count; });
    const std::size_t only = count > 4096 ? random_.below(count) : count;
    std::optional<Candidate> chosen;
    std::size_t seen = 0;
    each_pair(state, group, so_far, [&](std::size_t worker, std::int16_t carrier) {
      ++seen;
      const bool take = only < count ? seen == only + 1 : seen == 1 || random_.below(seen) == 0;
      if (take) chosen = candidate(state, group, worker, carrier);
    });
    return chosen;
  }

  const Simulator& simulator_;
  bool snapped_;
  bool first_;
  bool farthest_;
  bool random_choice_;
  RandomStream random_;
};

}  // namespace linewright::testing
