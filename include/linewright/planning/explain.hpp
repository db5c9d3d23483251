#pragma once

#include <optional>
#include <string>
#include <vector>

#include "linewright/allocation/allocator.hpp"
#include "linewright/planning/episode.hpp"
#include "linewright/planning/planner.hpp"
#include "linewright/simulation/simulator.hpp"

namespace linewright {

/// Why a decision of a run was as it was: what else could have been chosen, and what not.
struct DecisionExplanation {
  struct Alternative {
    TaskId task;
    /// When the run would end if this task were chosen now, its agents by the allocator, and then
    /// always the task that the base rule chooses; none: that future does not finish.
    std::optional<Tick> estimate;
    bool ruled_out = false;  ///< by the shield: the order could not be finished after it
  };
  struct Unselectable {
    TaskId task;
    std::string reason;  ///< Simulator::explain_unselectable
  };
  /// Who could have done the part of one member of the crew.
  struct Candidate {
    WorkerId worker;
    Leg way;  ///< to where the task first needs it; ticks -1: no way now
    bool chosen = false;
  };
  struct Member {
    std::string role;
    std::optional<StationId> needed_at;  ///< none: wherever it is
    std::vector<Candidate> candidates;   ///< all free workers of the kind, by number
  };

  Tick tick = 0;
  std::optional<Assignment> assignment;  ///< none: waits
  std::optional<Tick> planned_end;       ///< Decision::planned_end
  std::vector<Alternative> alternatives;
  std::vector<Unselectable> unselectable;
  std::vector<Member> members;
};

/// Explains the decision that is about to be taken in `state` (status kDecision). The rollouts cost
/// about 50 us each on the duct line. `base` and `allocator` are reset; those of the run must not
/// be given.
[[nodiscard]] DecisionExplanation explain_decision(const Simulator& simulator,
                                                   const SimulationState& state,
                                                   const GuardedDecision& decision, Planner& base,
                                                   Allocator& allocator);

}  // namespace linewright
