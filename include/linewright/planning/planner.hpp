#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "linewright/base/cancel.hpp"
#include "linewright/base/id.hpp"
#include "linewright/planning/task_set.hpp"
#include "linewright/simulation/assignment.hpp"
#include "linewright/simulation/simulator.hpp"

namespace linewright {

/// What may be decided now.
struct Choices {
  /// The selectable tasks, less those that somebody (such as a safety shield) rules out.
  TaskSet tasks;
  /// Waiting is allowed to every planner (LineModel::allow_wait, or nothing else is left). A
  /// planner that its user told to wait may do so without.
  bool wait = false;
};

/// Every selectable task of a state in which a decision is due, and waiting where the line allows
/// it.
[[nodiscard]] inline Choices all_choices(const Simulator& simulator, const SimulationState& state) {
  return {.tasks = TaskSet::selectable(state, simulator.line().tasks.size()),
          .wait = simulator.line().allow_wait};
}

/// What a planner decides.
struct Decision {
  std::optional<TaskId> task;  ///< none: wait until something happens
  /// Who does it, where the planner chooses that, too: complete and possible now. None: the
  /// allocator chooses.
  std::optional<Assignment> assignment;
  /// The tick in which the run ends if all goes on as the planner has in mind; none: it has nothing
  /// in mind, or not to the end.
  std::optional<Tick> planned_end;

  [[nodiscard]] static Decision wait() { return {}; }
};

/// The high-level agent: which task comes next (paper, Sec. 3.3). One Planner serves one run at a
/// time; it may keep a random stream, which `reset` starts anew.
class Planner {
 public:
  virtual ~Planner() = default;

  /// Starts a new run. Equal seeds give equal choices in equal states (but for planners whose
  /// budget is a time).
  virtual void reset(std::uint64_t seed) = 0;

  /// What happens at tick now + 1: one of `choices.tasks` (wait when there is none). Called only
  /// when a decision is due.
  [[nodiscard]] virtual Decision decide(const SimulationState& state, const Choices& choices) = 0;
};

/// What a planner may need to know about the run besides its state. All of it may be left out by
/// callers whose planners need none of it.
struct PlannerContext {
  /// Who does the tasks of the run (make_allocator): planners that look ahead simulate with it.
  std::string allocator = "sap";
  /// Nanoseconds of a clock that never goes back; the layers read none themselves. None: planners
  /// with a budget in time are an error.
  std::function<std::int64_t()> now_ns;
  /// Threads that one planner may use for one decision, >= 1. Never changes a result, but for
  /// budgets in time.
  std::size_t threads = 1;
  /// The scenario's file and Scenario::content_hash, for `priority:tuned`; empty: there is none.
  std::string scenario_file;
  std::uint64_t scenario_hash = 0;
  /// Stops a decision early: the best so far is taken. Must outlive the planner.
  const CancelToken* cancel = nullptr;
};

/// The planners a name can stand for. The name may be followed by ':' and what the planner takes:
/// - `random`: uniform over the tasks that may be chosen
/// - `first`: the one with the lowest number
/// - `priority:LIST`: the first one of a comma-separated list of task numbers or names; tasks that
///   the list leaves out come last, by number
///   `priority:tuned`: the list that tune_priority found for the scenario (priority_file.hpp)
/// - `policy:FILE`: a learned policy (policy_planner.hpp)
/// - `lookahead:BUDGET,...`: the best future found (lookahead.hpp)
/// - `fifo`, `spt`, ...: the dispatching rules (rules.hpp)
class PlannerRegistry {
 public:
  struct Entry {
    std::string name;
    std::string takes;  ///< what may follow the ':'; empty: nothing
    std::string summary;
  };

  [[nodiscard]] static const std::vector<Entry>& entries();

  /// Throws ScenarioError for an unknown name or a bad list. The simulator must outlive the
  /// planner.
  [[nodiscard]] static std::unique_ptr<Planner> make(std::string_view spec,
                                                     const Simulator& simulator,
                                                     const PlannerContext& context = {});
};

/// The planners of a comma-separated list. Planners may hold commas themselves: a new one begins
/// behind a comma only with a name of the registry (alone, or followed by ':').
[[nodiscard]] std::vector<std::string> split_planners(std::string_view list);

}  // namespace linewright
