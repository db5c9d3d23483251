#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "linewright/allocation/allocator.hpp"
#include "linewright/base/cancel.hpp"
#include "linewright/planning/planner.hpp"
#include "linewright/planning/shield.hpp"
#include "linewright/simulation/simulator.hpp"

namespace linewright {

/// What happens next in a run.
struct GuardedDecision {
  std::optional<Assignment> assignment;  ///< none: wait
  std::optional<Tick> planned_end;       ///< Decision::planned_end
  TaskSet masked;                        ///< tasks that the planner wanted and must not do now
};

/// What else belongs to a run; all of it may be left out.
struct EpisodeOptions {
  EventLog* log = nullptr;
  const CancelToken* cancel = nullptr;
  /// With both: appends how many nanoseconds of this clock each decision took (the planner and,
  /// where it is asked, the allocator).
  std::function<std::int64_t()> now_ns;
  std::vector<std::int64_t>* decision_ns = nullptr;
  /// Rules out decisions after which the order cannot be finished (guarded_decision); reset with
  /// the run. None: every selectable task may be chosen, as in the paper.
  Shield* shield = nullptr;
  std::int64_t* shield_ns = nullptr;  ///< with a clock: the shield's time is added here
  /// Called before each decision is carried out, with the state that it was taken in.
  std::function<void(const SimulationState&, const GuardedDecision&)> observe;
};

/// Asks the planner, and the allocator where the planner does not choose the agents, until the
/// shield lets a decision pass:
/// - one after which the order can be finished passes; one after which it cannot is masked;
/// - one of which that is not found out is masked, too, if another task, or waiting, is safe; if
///   none is, the first of these passes: the shield never stops a run because it is not sure.
/// With every selectable task masked the run waits. Without a shield everything passes.
[[nodiscard]] GuardedDecision guarded_decision(const Simulator& simulator,
                                               const SimulationState& state, Planner& planner,
                                               Allocator& allocator, const EpisodeOptions& options);

/// Plays a run from `setup` to its end: the planner chooses the tasks, the allocator who does them
/// unless the planner does that, too; both are reset with `seed` first. Returns how it ended;
/// kRunning when the cancel token was requested before. Throws std::logic_error when a planner
/// breaks its contract.
RunStatus run_episode(const Simulator& simulator, SimulationState& state, const RunSetup& setup,
                      std::uint64_t seed, Planner& planner, Allocator& allocator,
                      const EpisodeOptions& options = {});

}  // namespace linewright
