#include "linewright/allocation/allocator.hpp"

#include <fmt/format.h>

#include <array>
#include <limits>
#include <optional>

#include "best_choice.hpp"
#include "errand.hpp"
#include "free_members.hpp"
#include "linewright/base/diagnostic.hpp"
#include "linewright/base/random.hpp"

namespace linewright {
namespace {

using allocation::Best;
using allocation::Choice;
using allocation::Cost;
using allocation::Errand;
using allocation::FreeMembers;
using allocation::Spot;
using allocation::Standpoint;
using allocation::Start;

enum class Rule : std::uint8_t { kNearest, kFarthest, kRandom, kFirstIdle };

/// The way that goes on where the other ends; none when either is missing.
Leg joined(const Leg& way, const Leg& onward) {
  if (way.ticks < 0 || onward.ticks < 0) return {};
  return {way.ticks + onward.ticks, way.metres + onward.metres};
}

class RuleAllocator final : public Allocator {
 public:
  RuleAllocator(const Simulator& simulator, Rule rule, Standpoint standpoint)
      : simulator_(simulator),
        rule_(rule),
        standpoint_(standpoint),
        random_(0),
        members_(simulator) {
    for (const Task& task : simulator.line().tasks) {
      errands_.push_back(allocation::errands_of(task));
    }
  }

  void reset(std::uint64_t seed) override { random_ = RandomStream::derive(seed, "allocator"); }

  [[nodiscard]] bool draws() const override { return rule_ == Rule::kRandom; }

  Assignment allocate(const SimulationState& state, TaskId task) override {
    Assignment assignment(task);
    const auto& crew = crew_of(task);
    for (const Errand& errand : errands_[task.index()]) {
      const std::optional<Choice> best = choose(state, errand, assignment);
      if (!best) continue;  // a late joiner of whose kind nobody is free
      assignment.members[errand.worker_slot] = best->worker;
      if (errand.carrier_slot) assignment.members[*errand.carrier_slot] = best->carrier;
    }
    for (std::size_t slot = 0; slot < crew.size(); ++slot) {
      // Carriers that nobody fetches first (or whose fetcher joins late): by number.
      if (!crew[slot].carrier || assignment.members[slot] != Assignment::kNobody) continue;
      assignment.members[slot] = members_.first_carrier(state, assignment, slot);
    }
    return assignment;
  }

  WorkerId join(const SimulationState& state, PendingJoin pending) override {
    const Execution& execution = state.executions[pending.execution];
    Assignment bound{TaskId(std::int32_t{execution.task})};
    bound.members = execution.members;
    for (const Errand& errand : errands_[bound.task.index()]) {
      if (errand.worker_slot != pending.slot) continue;
      const std::optional<Choice> best = choose(state, errand, bound);
      if (best) return WorkerId(std::int32_t{best->worker});
    }
    return WorkerId(-1);
  }

 private:
  [[nodiscard]] const std::vector<CrewSlot>& crew_of(TaskId task) const {
    return simulator_.line().tasks[task.index()].crew;
  }

  /// The carrier that the errand has been given already; kNobody: none, or it needs none.
  static std::int16_t given_carrier(const Errand& errand, const Assignment& so_far) {
    return errand.carrier_slot ? so_far.members[*errand.carrier_slot] : Assignment::kNobody;
  }

  std::optional<Choice> choose(const SimulationState& state, const Errand& errand,
                               const Assignment& so_far) {
    if (rule_ == Rule::kRandom) return draw(state, errand, so_far);
    const auto& starts = members_.starts(state, so_far, errand.worker_slot, standpoint_);
    const std::int16_t given = given_carrier(errand, so_far);
    if (!errand.carrier_slot) return choose_alone(state, errand, starts);
    if (given < 0 && rule_ != Rule::kFirstIdle) {
      return choose_pair(state, errand, starts,
                         members_.spots(state, so_far.task, *errand.carrier_slot));
    }
    const std::int16_t carrier =
        given >= 0 ? given : members_.first_carrier(state, so_far, *errand.carrier_slot);
    if (carrier < 0) return std::nullopt;
    one_spot_.assign(1, {carrier, state.carriers[static_cast<std::size_t>(carrier)].station});
    return choose_pair(state, errand, starts, one_spot_);
  }

  std::optional<Choice> choose_alone(const SimulationState& state, const Errand& errand,
                                     const std::vector<Start>& starts) const {
    Best best;
    for (const Start& start : starts) {
      Cost cost;  // without a goal, and for kFirstIdle, all are alike
      if (errand.goal && rule_ != Rule::kFirstIdle) {
        cost = cost_of(way(state, start, *errand.goal));
      }
      best.consider(cost, {start.worker, Assignment::kNobody});
    }
    return best.choice();
  }

  std::optional<Choice> choose_pair(const SimulationState& state, const Errand& errand,
                                    const std::vector<Start>& starts,
                                    const std::vector<Spot>& spots) {
    Best best;
    measure_onward(state, errand, starts, spots);
    // Workers outside: the ways from one station lie side by side in the travel table.
    for (const Start& start : starts) {
      for (std::size_t s = 0; s < spots.size(); ++s) {
        // No way is shorter than its second half.
        if (rule_ == Rule::kNearest && best.is_below(onward_[s].ticks)) continue;
        best.consider(cost_of_pair(state, start, spots[s], onward_[s]),
                      {start.worker, spots[s].carrier});
      }
    }
    return best.choice();
  }

  /// Fills `onward_`: the ways from the spots to the goal. All starts are of one kind of worker.
  void measure_onward(const SimulationState& state, const Errand& errand,
                      const std::vector<Start>& starts, const std::vector<Spot>& spots) {
    onward_.assign(spots.size(), Leg{0, 0.0});
    if (starts.empty() || !errand.goal) return;
    const TravelTable& travel =
        simulator_.travel(state, WorkerKindId(kind_of(state, starts.front())));
    for (std::size_t s = 0; s < spots.size(); ++s) {
      onward_[s] = travel.leg(StationId(std::int32_t{spots[s].station}), *errand.goal);
    }
  }

  [[nodiscard]] Cost cost_of_pair(const SimulationState& state, const Start& start,
                                  const Spot& spot, const Leg& onward) const {
    const StationId stands(std::int32_t{spot.station});
    if (rule_ == Rule::kFirstIdle) return {0, straight_m(kind_of(state, start), start, stands)};
    return cost_of(joined(way(state, start, stands), onward));
  }

  static std::size_t kind_of(const SimulationState& state, const Start& start) {
    return static_cast<std::size_t>(state.workers[static_cast<std::size_t>(start.worker)].kind);
  }

  [[nodiscard]] Leg way(const SimulationState& state, const Start& start, StationId to) const {
    const WorkerId worker(std::int32_t{start.worker});
    if (standpoint_ == Standpoint::kReal) return simulator_.route_from_worker(state, worker, to);
    return simulator_.travel(state, WorkerKindId(kind_of(state, start)))
        .leg(StationId(std::int32_t{start.station}), to);
  }

  [[nodiscard]] double straight_m(std::size_t kind, const Start& start, StationId to) const {
    const auto point = [&](StationId station) {
      return simulator_.line().stations[station.index()].poses[kind].value_or(Pose2{}).point();
    };
    return distance_m(point(StationId(std::int32_t{start.station})), point(to));
  }

  /// Where there is no way the ticks are -1.
  [[nodiscard]] Cost cost_of(const Leg& way) const {
    if (way.ticks < 0) return {std::numeric_limits<Tick>::max(), 0.0};
    if (rule_ == Rule::kFarthest) return {-way.ticks, -way.metres};
    return {way.ticks, way.metres};
  }

  /// One of all (carrier, worker), carriers outside; each is as likely.
  std::optional<Choice> draw(const SimulationState& state, const Errand& errand,
                             const Assignment& so_far) {
    const auto& workers = members_.workers(state, so_far, errand.worker_slot);
    const std::int16_t given = given_carrier(errand, so_far);
    if (!errand.carrier_slot || given >= 0) {
      if (workers.empty()) return std::nullopt;
      return Choice{workers[draw_index(workers.size())], given};
    }
    const auto& carriers = members_.carriers(state, so_far.task, *errand.carrier_slot);
    if (workers.empty() || carriers.empty()) return std::nullopt;
    const std::size_t pair = draw_index(workers.size() * carriers.size());
    return Choice{workers[pair % workers.size()], carriers[pair / workers.size()]};
  }

  /// 0 ... count - 1. One candidate needs no draw: with nothing to choose all allocators give the
  /// same run.
  std::size_t draw_index(std::size_t count) {
    // As many as 64 workers and 64 carriers make. Up to here each candidate replaces the earlier
    // ones by a draw of its own, which recorded runs depend on; beyond, one draw has to do.
    constexpr std::size_t kMostDraws = 64 * 64;
    if (count > kMostDraws) return random_.below(count);
    std::size_t index = 0;
    for (std::size_t seen = 2; seen <= count; ++seen) {
      if (random_.below(seen) == 0) index = seen - 1;
    }
    return index;
  }

  const Simulator& simulator_;
  Rule rule_;
  Standpoint standpoint_;
  RandomStream random_;
  FreeMembers members_;
  std::vector<std::vector<Errand>> errands_;  ///< by task
  // Scratch, kept so that a choice allocates nothing.
  std::vector<Spot> one_spot_;
  std::vector<Leg> onward_;
};

struct Named {
  std::string_view name;
  Rule rule;
  Standpoint standpoint;
};

constexpr std::array<Named, 5> kRules{{
    {"sap", Rule::kNearest, Standpoint::kReal},
    {"no_spatial", Rule::kRandom, Standpoint::kReal},
    {"longest_path", Rule::kFarthest, Standpoint::kReal},
    {"first_idle", Rule::kFirstIdle, Standpoint::kStation},
    {"sap_snapped", Rule::kNearest, Standpoint::kSnapped},
}};

}  // namespace

const std::vector<std::string>& allocator_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Named& rule : kRules) all.emplace_back(rule.name);
    return all;
  }();
  return names;
}

std::unique_ptr<Allocator> make_allocator(std::string_view name, const Simulator& simulator) {
  for (const Named& rule : kRules) {
    if (rule.name == name) {
      return std::make_unique<RuleAllocator>(simulator, rule.rule, rule.standpoint);
    }
  }
  throw ScenarioError({}, fmt::format("unknown allocator '{}'", name),
                      name_hint(name, allocator_names()));
}

}  // namespace linewright
