#include "linewright/planning/dead_states.hpp"

#include <algorithm>
#include <memory>

#include "linewright/allocation/advance.hpp"
#include "linewright/allocation/allocator.hpp"
#include "linewright/planning/episode.hpp"
#include "linewright/planning/planner.hpp"
#include "search_futures.hpp"

namespace linewright {
namespace {

/// Searches the futures of a state.
class Search {
 public:
  Search(const Simulator& simulator, const DeadStateOptions& options, const CancelToken* cancel)
      : simulator_(simulator),
        options_(options),
        cancel_(cancel),
        allocator_(make_allocator("sap", simulator)) {
    for (std::size_t t = 0; t < simulator.line().tasks.size(); ++t) tasks_.emplace_back(t);
  }

  Liveness run(SimulationState state) {
    state.horizon = kMaxTicks;  // deadness is not a question of time
    if (state.status == RunStatus::kHorizon) state.status = RunStatus::kRunning;
    if (some_rollout_finishes(state)) return {Liveness::Verdict::kAlive, 0};
    return exhaust(state);
  }

 private:
  /// Uniformly random choices among the selectable tasks and waiting.
  bool some_rollout_finishes(const SimulationState& from) {
    auto random = RandomStream::derive(options_.seed, "rollouts");
    SimulationState state;
    for (std::size_t r = 0; r < options_.rollouts; ++r) {
      state = from;
      for (std::size_t steps = 0; steps < kLongestRollout; ++steps) {
        if (advance_and_join(simulator_, state, *allocator_) != RunStatus::kDecision) break;
        selectable_tasks(state);
        const std::size_t choice = random.below(choices_.size() + 1);
        if (choice < choices_.size()) {
          simulator_.assign(state, allocator_->allocate(state, choices_[choice]));
        } else if (!simulator_.wait(state)) {
          break;  // only waiting is left to try, and nothing is under way
        }
      }
      if (state.status == RunStatus::kFinished) return true;
      if (cancel_ != nullptr && cancel_->requested()) return false;
    }
    return false;
  }

  void selectable_tasks(const SimulationState& state) {
    choices_.clear();
    for (const TaskId task : tasks_) {
      if (state.is_selectable(task)) choices_.push_back(task);
    }
  }

  Liveness exhaust(const SimulationState& start) {
    const planning::SearchedFutures futures = planning::search_futures(
        simulator_, *allocator_, start,
        {.order = tasks_,
         .most = options_.max_states,
         .give_up = [&] { return cancel_ != nullptr && cancel_->requested(); },
         .known = {}});
    if (!futures.finishes) return {Liveness::Verdict::kUnknown, futures.seen.size()};
    return {*futures.finishes ? Liveness::Verdict::kAlive : Liveness::Verdict::kDead,
            futures.seen.size()};
  }

  static constexpr std::size_t kLongestRollout = 100'000;

  const Simulator& simulator_;
  const DeadStateOptions& options_;
  const CancelToken* cancel_;
  std::unique_ptr<Allocator> allocator_;
  std::vector<TaskId> tasks_;
  std::vector<TaskId> choices_;
};

/// One random run with the states before each of its decisions.
struct Trail {
  std::vector<SimulationState> before;
  std::vector<DeadState::Decision> decisions;
  SimulationState end;
};

Trail random_trail(const Simulator& simulator, const RunSetup& setup, std::uint64_t seed) {
  Trail trail;
  const auto planner = PlannerRegistry::make("random", simulator);
  const auto allocator = make_allocator("sap", simulator);
  planner->reset(seed);
  SimulationState& state = trail.end;
  simulator.reset(state, setup);
  while (advance_and_join(simulator, state, *allocator) == RunStatus::kDecision) {
    const auto task = planner->decide(state, all_choices(simulator, state)).task;
    trail.before.push_back(state);
    trail.decisions.push_back({state.now + 1, *task});
    simulator.assign(state, allocator->allocate(state, *task));
  }
  return trail;
}

/// The state after decision `n` (0-based) of the trail.
const SimulationState& after(const Trail& trail, std::size_t n) {
  return n + 1 < trail.before.size() ? trail.before[n + 1] : trail.end;
}

/// The first decision of a stuck run after which the order could not be finished any more. Once
/// dead, always dead: bisection.
DeadState first_fatal(const Simulator& simulator, const Trail& trail,
                      const DeadStateOptions& options, const CancelToken* cancel) {
  Search search(simulator, options, cancel);
  std::size_t alive = 0;                       // decisions 0 .. alive - 1 leave it alive
  std::size_t dead = trail.decisions.size();   // decision dead - 1 leaves it dead
  Liveness last{Liveness::Verdict::kDead, 0};  // the stuck end itself needs no search
  while (dead - alive > 1) {
    const std::size_t middle = alive + (dead - alive) / 2;
    const Liveness verdict = search.run(after(trail, middle - 1));
    if (verdict.verdict == Liveness::Verdict::kAlive) {
      alive = middle;
    } else {
      dead = middle;
      last = verdict;
    }
  }
  DeadState found;
  found.decisions.assign(trail.decisions.begin(),
                         trail.decisions.begin() + static_cast<std::ptrdiff_t>(dead));
  found.proven = last.verdict == Liveness::Verdict::kDead;
  found.states_searched = last.states_searched;
  found.stuck_at = trail.end.now;
  for (std::size_t t = 0; t < simulator.line().tasks.size(); ++t) {
    found.reasons.push_back(simulator.explain_unselectable(trail.end, TaskId(t)));
  }
  found.occurrences = 1;
  return found;
}

void merge(std::vector<DeadState>& all, DeadState found) {
  for (DeadState& known : all) {
    if (known.decisions.back().task != found.decisions.back().task) continue;
    found.occurrences += known.occurrences;
    if (found.decisions.size() < known.decisions.size()) {
      known = std::move(found);
    } else {
      known.occurrences = found.occurrences;
    }
    return;
  }
  all.push_back(std::move(found));
}

}  // namespace

Liveness can_finish(const Simulator& simulator, const SimulationState& state,
                    const DeadStateOptions& options, const CancelToken* cancel) {
  return Search(simulator, options, cancel).run(state);
}

DeadStateReport find_dead_states(const Simulator& simulator, const RunOptions& crew,
                                 const DeadStateOptions& options, const CancelToken* cancel) {
  DeadStateReport report;
  for (std::size_t r = 0; r < options.runs; ++r) {
    if (cancel != nullptr && cancel->requested()) break;
    const std::uint64_t seed = RandomStream::derive(options.seed, "dead_states", r).next();
    const Trail trail = random_trail(simulator, sample_setup(simulator.line(), crew, seed), seed);
    ++report.runs;
    if (trail.end.status != RunStatus::kDeadlock) continue;
    ++report.stuck;
    if (trail.decisions.empty()) continue;
    merge(report.found, first_fatal(simulator, trail, options, cancel));
  }
  std::sort(report.found.begin(), report.found.end(), [](const DeadState& a, const DeadState& b) {
    return a.decisions.size() != b.decisions.size()
               ? a.decisions.size() < b.decisions.size()
               : a.decisions.back().task < b.decisions.back().task;
  });
  return report;
}

}  // namespace linewright
