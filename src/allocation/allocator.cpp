#include "linewright/allocation/allocator.hpp"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <utility>
#include <variant>

#include "linewright/base/diagnostic.hpp"
#include "linewright/base/random.hpp"

namespace linewright {
namespace {

/// Crew slots that are filled together: a worker, maybe with the carrier it fetches.
struct Group {
  std::size_t worker_slot = 0;
  std::optional<std::size_t> carrier_slot;
  std::optional<StationId>
      goal;  ///< where the worker goes first (with the carrier, if it fetches one)
};

/// One way to fill a group and the way it costs.
struct Candidate {
  std::int16_t worker = Assignment::kNobody;
  std::int16_t carrier = Assignment::kNobody;
  Leg way;
  double straight_m = 0.0;  ///< straight line from the worker's station to the carrier's
};

enum class Rule { kNearest, kFarthest, kRandom, kFirstIdle };

/// What the crew member does first that says where it has to be.
Group first_errand(const Task& task, std::size_t slot) {
  Group group{.worker_slot = slot, .carrier_slot = std::nullopt, .goal = std::nullopt};
  for (const Step& step : task.steps) {
    for (const ActorSequence& sequence : step.sequences) {
      if (sequence.slot != slot) continue;
      for (const Action& action : sequence.actions) {
        if (const auto* fetch = std::get_if<FetchAction>(&action.what);
            fetch && !group.carrier_slot) {
          group.carrier_slot = fetch->carrier_slot;
        } else if (const auto* go = std::get_if<GoAction>(&action.what)) {
          group.goal = go->station;
          return group;
        }
      }
    }
  }
  return group;
}

std::vector<Group> groups_of(const Task& task) {
  std::vector<Group> groups;
  std::vector<bool> taken(task.crew.size(), false);
  for (std::size_t slot = 0; slot < task.crew.size(); ++slot) {
    if (!task.crew[slot].worker) continue;
    Group group = first_errand(task, slot);
    if (group.carrier_slot && taken[*group.carrier_slot]) group.carrier_slot.reset();
    if (group.carrier_slot) taken[*group.carrier_slot] = true;
    groups.push_back(group);
  }
  return groups;
}

class RuleAllocator final : public Allocator {
 public:
  RuleAllocator(const Simulator& simulator, Rule rule)
      : simulator_(simulator), rule_(rule), random_(0) {
    for (const Task& task : simulator.line().tasks) groups_.push_back(groups_of(task));
  }

  void reset(std::uint64_t seed) override { random_ = RandomStream::derive(seed, "allocator"); }

  Assignment allocate(const SimulationState& state, TaskId task) override {
    Assignment assignment(task);
    const auto& crew = simulator_.line().tasks[task.index()].crew;
    for (const Group& group : groups_[task.index()]) {
      const std::optional<Candidate> best = choose(state, crew, group, assignment);
      if (!best) continue;  // a late joiner of whose kind nobody is free
      assignment.members[group.worker_slot] = best->worker;
      if (group.carrier_slot) assignment.members[*group.carrier_slot] = best->carrier;
    }
    for (std::size_t slot = 0; slot < crew.size(); ++slot) {
      // Carriers that nobody fetches first (or whose fetcher joins late): by number.
      if (!crew[slot].carrier || assignment.members[slot] != Assignment::kNobody) continue;
      for (std::size_t c = 0; c < state.carriers.size(); ++c) {
        const auto carrier = static_cast<std::int16_t>(c);
        if (in_crew(crew, assignment, slot, carrier)) continue;
        if (!simulator_.carrier_fits(state, crew[slot], CarrierId(c))) continue;
        assignment.members[slot] = carrier;
        break;
      }
    }
    return assignment;
  }

  WorkerId join(const SimulationState& state, PendingJoin pending) override {
    const Execution& execution = state.executions[pending.execution];
    const auto task = static_cast<std::size_t>(execution.task);
    const auto& crew = simulator_.line().tasks[task].crew;
    Assignment bound{TaskId(std::int32_t{execution.task})};
    bound.members = execution.members;
    for (const Group& group : groups_[task]) {
      if (group.worker_slot != pending.slot) continue;
      const std::optional<Candidate> best = choose(state, crew, group, bound);
      if (best) return WorkerId(std::int32_t{best->worker});
    }
    return WorkerId(-1);
  }

 private:
  /// Whether `member` fills another slot of the same sort (worker or carrier) already.
  static bool in_crew(const std::vector<CrewSlot>& crew, const Assignment& assignment,
                      std::size_t slot, std::int16_t member) {
    for (std::size_t other = 0; other < crew.size(); ++other) {
      if (other != slot && assignment.members[other] == member &&
          crew[other].worker.has_value() == crew[slot].worker.has_value()) {
        return true;
      }
    }
    return false;
  }

  Candidate candidate(const SimulationState& state, const Group& group, std::size_t worker,
                      std::int16_t carrier) const {
    Candidate made{
        .worker = static_cast<std::int16_t>(worker), .carrier = carrier, .way = {0, 0.0}};
    const WorkerId id(worker);
    const auto kind = static_cast<std::size_t>(state.workers[worker].kind);
    if (carrier < 0) {
      if (group.goal) made.way = simulator_.route_from_worker(state, id, *group.goal);
      return made;
    }
    const StationId stands(std::int32_t{state.carriers[static_cast<std::size_t>(carrier)].station});
    made.way = simulator_.route_from_worker(state, id, stands);
    if (group.goal) {
      const Leg& onward = simulator_.line().travel[kind].leg(stands, *group.goal);
      made.way.ticks += onward.ticks;
      made.way.metres += onward.metres;
    }
    const auto point = [&](StationId station) {
      return simulator_.line().stations[station.index()].poses[kind].value_or(Pose2{}).point();
    };
    made.straight_m =
        distance_m(point(StationId(std::int32_t{state.workers[worker].station})), point(stands));
    return made;
  }

  /// Whether `a` is to be preferred to `b`, which came earlier (ties: the earlier one stays).
  bool better(const Candidate& a, const Candidate& b) const {
    switch (rule_) {
      case Rule::kNearest:
        return a.way.ticks != b.way.ticks ? a.way.ticks < b.way.ticks : a.way.metres < b.way.metres;
      case Rule::kFarthest:
        return a.way.ticks != b.way.ticks ? a.way.ticks > b.way.ticks : a.way.metres > b.way.metres;
      case Rule::kFirstIdle:
        return a.carrier == b.carrier && a.straight_m < b.straight_m;
      case Rule::kRandom:
        return false;  // chosen by reservoir in choose()
    }
    return false;
  }

  std::optional<Candidate> choose(const SimulationState& state, const std::vector<CrewSlot>& crew,
                                  const Group& group, const Assignment& so_far) {
    std::optional<Candidate> best;
    std::size_t seen = 0;
    const auto consider = [&](std::size_t worker, std::int16_t carrier) {
      ++seen;
      if (rule_ == Rule::kRandom) {
        // One candidate needs no draw: with nothing to choose all allocators give the same run.
        if (seen == 1 || random_.below(seen) == 0) best = candidate(state, group, worker, carrier);
        return;
      }
      const Candidate made = candidate(state, group, worker, carrier);
      if (!best || better(made, *best)) best = made;
    };
    const CrewSlot& slot = crew[group.worker_slot];
    const auto each_worker = [&](std::int16_t carrier) {
      for (std::size_t w = 0; w < state.workers.size(); ++w) {
        if (!state.workers[w].free() || state.workers[w].kind != slot.worker->value) continue;
        if (in_crew(crew, so_far, group.worker_slot, static_cast<std::int16_t>(w))) continue;
        consider(w, carrier);
      }
    };
    if (!group.carrier_slot) {
      each_worker(Assignment::kNobody);
    } else if (const std::int16_t given = so_far.members[*group.carrier_slot]; given >= 0) {
      each_worker(given);
    } else {
      for (std::size_t c = 0; c < state.carriers.size(); ++c) {
        if (simulator_.carrier_fits(state, crew[*group.carrier_slot], CarrierId(c))) {
          each_worker(static_cast<std::int16_t>(c));
        }
      }
    }
    return best;
  }

  const Simulator& simulator_;
  Rule rule_;
  RandomStream random_;
  std::vector<std::vector<Group>> groups_;  ///< by task
};

constexpr std::array<std::pair<std::string_view, Rule>, 4> kRules{{
    {"sap", Rule::kNearest},
    {"no_spatial", Rule::kRandom},
    {"longest_path", Rule::kFarthest},
    {"first_idle", Rule::kFirstIdle},
}};

}  // namespace

const std::vector<std::string>& allocator_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const auto& rule : kRules) all.emplace_back(rule.first);
    return all;
  }();
  return names;
}

std::unique_ptr<Allocator> make_allocator(std::string_view name, const Simulator& simulator) {
  for (const auto& [known, rule] : kRules) {
    if (known == name) return std::make_unique<RuleAllocator>(simulator, rule);
  }
  throw ScenarioError({}, fmt::format("unknown allocator '{}'", name),
                      name_hint(name, allocator_names()));
}

}  // namespace linewright
