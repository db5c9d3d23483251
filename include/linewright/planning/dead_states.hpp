#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "linewright/base/cancel.hpp"
#include "linewright/simulation/simulator.hpp"

namespace linewright {

/// How hard find_dead_states looks.
struct DeadStateOptions {
  std::size_t runs = 200;  ///< random runs that look for dead states; more find rarer ones
  std::uint64_t seed = 1;
  std::size_t rollouts = 64;  ///< random continuations that try to show that a state is alive
  std::size_t max_states =
      200'000;  ///< states searched to prove that one is dead (about 2 us and 16 bytes each)
};

/// A decision after which the order can never be finished, whatever is decided later and however
/// long one waits with it (also on lines whose planners may not wait: the marking itself is dead).
struct DeadState {
  struct Decision {
    Tick tick = 0;
    TaskId task;
  };

  std::vector<Decision> decisions;  ///< from the start up to and with the fatal one (the last)
  bool proven = false;  ///< every continuation was searched; else: none was found that finishes
  std::size_t states_searched = 0;
  Tick stuck_at = 0;                 ///< when the run that led here came to a stand
  std::vector<std::string> reasons;  ///< by task: why it could not start then
  std::size_t occurrences = 0;       ///< runs with the same fatal task
};

struct DeadStateReport {
  std::size_t runs = 0;
  std::size_t stuck = 0;         ///< runs that came to a stand before the order was finished
  std::vector<DeadState> found;  ///< one per fatal task: that with the fewest decisions
};

/// Whether the order can still be finished from `state`, the horizon aside.
struct Liveness {
  enum class Verdict { kAlive, kDead, kUnknown };
  Verdict verdict = Verdict::kUnknown;
  std::size_t states_searched = 0;
};

/// Random continuations first (one that finishes settles it), then an exhaustive search with memory
/// over the decisions, up to the limit. Agents are chosen as by allocator `sap`.
[[nodiscard]] Liveness can_finish(const Simulator& simulator, const SimulationState& state,
                                  const DeadStateOptions& options,
                                  const CancelToken* cancel = nullptr);

/// Looks for dead states: random runs of the crew; in each that comes to a stand, the first
/// decision that was fatal. Deterministic for a seed.
[[nodiscard]] DeadStateReport find_dead_states(const Simulator& simulator, const RunOptions& crew,
                                               const DeadStateOptions& options,
                                               const CancelToken* cancel = nullptr);

}  // namespace linewright
