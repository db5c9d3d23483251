#include "linewright/planning/rules.hpp"

#include <algorithm>
#include <optional>
#include <utility>
#include <variant>

#include "linewright/allocation/allocator.hpp"
#include "task_facts.hpp"

namespace linewright {
namespace {

using planning::kNowhere;
using planning::LineFacts;
using planning::TaskFacts;

/// Takes the task with the lowest score; a score may have two parts.
using Score = std::pair<double, double>;

/// A rule without memory.
class RulePlanner : public Planner {
 public:
  explicit RulePlanner(const Simulator& simulator)
      : simulator_(simulator), facts_(planning::facts_of(simulator.line())) {}

  void reset(std::uint64_t /*seed*/) override {}

  Decision decide(const SimulationState& state, const Choices& choices) override {
    Decision decision;
    Score least;
    choices.tasks.each([&](TaskId task) {
      const Score own = score(state, task);
      if (decision.task && !(own < least)) return;
      decision.task = task;
      least = own;
    });
    return decision;
  }

 protected:
  [[nodiscard]] virtual Score score(const SimulationState& state, TaskId task) = 0;

  [[nodiscard]] const TaskFacts& facts(TaskId task) const { return facts_.tasks[task.index()]; }
  [[nodiscard]] double pace(PlaceId place) const { return facts_.pace[place.index()]; }
  [[nodiscard]] double items(const SimulationState& state, PlaceId place) const {
    return simulator_.value(state, {VariableKind::kPlaceCount, place.value});
  }

  const Simulator& simulator_;

 private:
  LineFacts facts_;
};

class Fifo final : public RulePlanner {
 public:
  explicit Fifo(const Simulator& simulator)
      : RulePlanner(simulator), since_(simulator.line().tasks.size()) {}

  void reset(std::uint64_t /*seed*/) override { forget(); }

  Decision decide(const SimulationState& state, const Choices& choices) override {
    if (state.now < latest_) forget();  // another run
    latest_ = state.now;
    for (std::size_t t = 0; t < since_.size(); ++t) {
      if (!state.is_selectable(TaskId(t))) {
        since_[t].reset();
      } else if (!since_[t]) {
        since_[t] = state.now;
      }
    }
    const Decision decision = RulePlanner::decide(state, choices);
    if (decision.task) since_[decision.task->index()].reset();
    return decision;
  }

 protected:
  Score score(const SimulationState& state, TaskId task) override {
    return {since_[task.index()].value_or(state.now), 0.0};
  }

 private:
  void forget() {
    std::fill(since_.begin(), since_.end(), std::nullopt);
    latest_ = 0;
  }

  std::vector<std::optional<Tick>> since_;
  Tick latest_ = 0;
};

/// The rules that only look at one task and the marking.
class PlainRule final : public RulePlanner {
 public:
  enum class Kind : std::uint8_t { kSpt, kLpt, kMwkr, kCriticalRatio, kUrgentBuffer, kBottleneck };

  PlainRule(const Simulator& simulator, Kind kind) : RulePlanner(simulator), kind_(kind) {}

 protected:
  Score score(const SimulationState& state, TaskId task) override {
    const TaskFacts& own = facts(task);
    switch (kind_) {
      case Kind::kSpt:
        return {own.work, 0.0};
      case Kind::kLpt:
        return {-own.work, 0.0};
      case Kind::kMwkr:
        return {-remaining(own), 0.0};
      case Kind::kCriticalRatio:
        return {lasts(state, own) / std::max(1.0, own.work), -remaining(own)};
      case Kind::kUrgentBuffer:
        return {fill_share(state, own), -own.work};
      case Kind::kBottleneck:
        return {own.to_bottleneck, 0.0};
    }
    return {};
  }

 private:
  static double remaining(const TaskFacts& own) {
    return own.work + (own.tail < kNowhere ? own.tail : 0.0);
  }

  [[nodiscard]] double lasts(const SimulationState& state, const TaskFacts& own) const {
    double least = kNowhere;
    for (const PlaceId place : own.buffers) {
      const double count = items(state, place);
      if (count > 0.0 && pace(place) == kNowhere) continue;
      least = std::min(least, count > 0.0 ? count * pace(place) : 0.0);
    }
    return least;
  }

  [[nodiscard]] double fill_share(const SimulationState& state, const TaskFacts& own) const {
    double least = kNowhere;
    for (const PlaceId place : own.buffers) {
      const Place& model = simulator_.line().places[place.index()];
      std::int32_t capacity = std::max(1, state.order);
      if (model.capacity) capacity = *model.capacity;
      if (model.berth) {
        capacity = simulator_.line().carrier_kinds[model.berth->carrier.index()].capacity;
      }
      least = std::min(least, items(state, place) / std::max(1, capacity));
    }
    return least;
  }

  Kind kind_;
};

class Nearest final : public RulePlanner {
 public:
  explicit Nearest(const Simulator& simulator)
      : RulePlanner(simulator), allocator_(make_allocator("sap", simulator)) {}

 protected:
  Score score(const SimulationState& state, TaskId task) override {
    const Assignment assignment = allocator_->allocate(state, task);
    const auto& crew = simulator_.line().tasks[task.index()].crew;
    double longest = 0.0;
    for (std::size_t slot = 0; slot < crew.size(); ++slot) {
      if (!crew[slot].worker || assignment.members[slot] < 0) continue;
      longest = std::max(longest, first_way(state, assignment, slot));
    }
    return {longest, 0.0};
  }

 private:
  /// Ticks until the member is at the first station of the task, with the carrier it fetches.
  [[nodiscard]] double first_way(const SimulationState& state, const Assignment& assignment,
                                 std::size_t slot) const {
    const Task& task = simulator_.line().tasks[assignment.task.index()];
    const WorkerId worker(std::int32_t{assignment.members[slot]});
    std::optional<StationId> carrier_at;
    for (const Step& step : task.steps) {
      for (const ActorSequence& sequence : step.sequences) {
        if (sequence.slot != slot) continue;
        for (const Action& action : sequence.actions) {
          if (const auto* fetch = std::get_if<FetchAction>(&action.what)) {
            const auto id = static_cast<std::size_t>(assignment.members[fetch->carrier_slot]);
            carrier_at = StationId(std::int32_t{state.carriers[id].station});
          } else if (const auto* go = std::get_if<GoAction>(&action.what)) {
            return way(state, worker, carrier_at, go->station);
          }
        }
      }
    }
    return carrier_at ? way(state, worker, std::nullopt, *carrier_at) : 0.0;
  }

  [[nodiscard]] double way(const SimulationState& state, WorkerId worker,
                           std::optional<StationId> over, StationId to) const {
    const Leg leg = simulator_.route_from_worker(state, worker, over.value_or(to));
    if (leg.ticks < 0) return kNowhere;
    if (!over) return leg.ticks;
    const WorkerKindId kind(std::int32_t{state.workers[worker.index()].kind});
    const Leg onward = simulator_.travel(state, kind).leg(*over, to);
    return onward.ticks < 0 ? kNowhere : leg.ticks + onward.ticks;
  }

  std::unique_ptr<Allocator> allocator_;
};

std::unique_ptr<Planner> plain(const Simulator& simulator, PlainRule::Kind kind) {
  return std::make_unique<PlainRule>(simulator, kind);
}

struct Known {
  Rule rule;
  std::unique_ptr<Planner> (*make)(const Simulator&);
};

using Kind = PlainRule::Kind;

const std::vector<Known>& known_rules() {
  static const std::vector<Known> all{
      {{"fifo", "the task that has been selectable the longest"},
       [](const Simulator& s) -> std::unique_ptr<Planner> { return std::make_unique<Fifo>(s); }},
      {{"spt", "the task with the least work"},
       [](const Simulator& s) { return plain(s, Kind::kSpt); }},
      {{"lpt", "the task with the most work"},
       [](const Simulator& s) { return plain(s, Kind::kLpt); }},
      {{"mwkr", "the task with the most work left until the product is finished"},
       [](const Simulator& s) { return plain(s, Kind::kMwkr); }},
      {{"nearest", "the task whose crew is at its place first"},
       [](const Simulator& s) -> std::unique_ptr<Planner> { return std::make_unique<Nearest>(s); }},
      {{"critical_ratio", "the task with the least time left for its work"},
       [](const Simulator& s) { return plain(s, Kind::kCriticalRatio); }},
      {{"most_urgent_buffer", "the task whose buffer is the emptiest"},
       [](const Simulator& s) { return plain(s, Kind::kUrgentBuffer); }},
      {{"bottleneck_first", "the task that feeds the busiest machine soonest"},
       [](const Simulator& s) { return plain(s, Kind::kBottleneck); }},
  };
  return all;
}

}  // namespace

const std::vector<Rule>& dispatching_rules() {
  static const std::vector<Rule> rules = [] {
    std::vector<Rule> all;
    for (const Known& known : known_rules()) all.push_back(known.rule);
    return all;
  }();
  return rules;
}

std::unique_ptr<Planner> make_rule_planner(std::string_view name, const Simulator& simulator) {
  for (const Known& known : known_rules()) {
    if (known.rule.name == name) return known.make(simulator);
  }
  return nullptr;
}

}  // namespace linewright
