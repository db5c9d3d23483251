#pragma once

#include <optional>
#include <string>
#include <vector>

#include "linewright/allocation/allocator.hpp"
#include "linewright/simulation/simulator.hpp"

namespace linewright {

/// One decision of a recorded run.
struct RecordedDecision {
  Tick tick = 0;
  TaskId task;
  /// By crew slot of the task; kNobody: not recorded, the fallback allocator chooses.
  std::array<std::int16_t, kMaxCrew> members{};
  /// By crew slot: who joined late; kNobody: nobody, or not recorded.
  std::array<std::int16_t, kMaxCrew> joiners{};

  RecordedDecision() {
    members.fill(Assignment::kNobody);
    joiners.fill(Assignment::kNobody);
  }
};

/// What became of a recorded decision.
struct ReplayedDecision {
  Tick recorded = 0;
  std::optional<Tick> taken;  ///< none: it never became possible
  std::string refusal;  ///< why not at the recorded tick (the last reason, when never); else empty
};

struct ReplayResult {
  std::vector<ReplayedDecision> decisions;
  RunStatus status = RunStatus::kRunning;
};

/// Plays recorded decisions in their order: each at its tick, or at the first later tick at which
/// it is possible with its agents. After the last one the run goes on, without further decisions,
/// to its end. A decision that is not possible before the run ends stops the replay there.
ReplayResult replay(const Simulator& simulator, SimulationState& state, const RunSetup& setup,
                    const std::vector<RecordedDecision>& decisions, Allocator& fallback,
                    EventLog* log = nullptr);

}  // namespace linewright
