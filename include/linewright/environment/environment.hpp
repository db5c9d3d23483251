#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "linewright/allocation/allocator.hpp"
#include "linewright/base/random.hpp"
#include "linewright/environment/observation.hpp"
#include "linewright/simulation/run_setup.hpp"
#include "linewright/simulation/simulator.hpp"

namespace linewright {

/// Weights of the reward R = r_time + r_progress + r_goal (paper, eq. 12). The published runs used
/// these values, but 0.001 for eta1.
struct RewardOptions {
  double eta1 = 0.01;  ///< paid per tick since the last decision, >= 0
  double eta2 = 1.0;   ///< won when the order is finished, paid when the run ends without; >= 0
  double eta3 = 0.2;   ///< won for the whole order, in shares as it is finished, >= 0
  /// Won with every decision, >= 0. The published runs had 0.1, which the paper does not mention;
  /// it pays for splitting one transport into many.
  double decision_bonus = 0.0;
};

/// Pauses in which nobody decides, as on a floor where people are not always ready at once. What
/// they cost is not counted: neither reward nor makespan nor horizon know of them. While learning
/// they lead to states that a line which never stops does not come to, such as an empty line with
/// one product left, and so to policies that also fit other orders.
struct PauseOptions {
  double episodes = 0.0;   ///< share of the episodes that have pauses, 0 to 1
  double decisions = 0.1;  ///< share of the decisions in these before which there is one, 0 to 1
  Tick most = 200;         ///< ticks of the longest; each length from 1 on is as likely
};

/// What a decision led to.
struct StepResult {
  float reward = 0.0F;
  bool ended = false;    ///< the run has ended: success, deadlock and horizon are all terminal
  bool success = false;  ///< the order was finished within the horizon
  bool paused = false;   ///< there was a pause before the next decision: time that was not counted
};

/// The Markov decision process of the high-level agent (paper, Sec. 3.3.1): a state is what an
/// ObservationEncoder shows of a run, an action is the next task (or to wait), a transition goes to
/// the next decision. The allocator decides who does it. One Environment plays one run at a time.
class Environment {
 public:
  /// The simulator must outlive the environment. Throws ScenarioError for an unknown allocator.
  Environment(const Simulator& simulator, const std::string& allocator,
              const RewardOptions& rewards, const PauseOptions& pauses = {});

  /// Starts a new run and goes on to its first decision. Returns false when it ends without any.
  bool reset(const RunSetup& setup, std::uint64_t seed);

  /// Takes the decision and goes on to the next one or to the end of the run. The action is an
  /// index into ObservationSpec::actions that is selectable now. A deadlock counts as what it is to
  /// the floor: nothing moves until the horizon, and the time until then is paid for.
  StepResult step(std::size_t action);

  [[nodiscard]] const SimulationState& state() const { return state_; }

  /// Ticks that the run took; of a failed one its horizon.
  [[nodiscard]] Tick makespan() const;
  [[nodiscard]] Tick horizon() const { return state_.horizon - horizon_added_; }

 private:
  StepResult rewarded(Tick before, double progress_before);
  RunStatus advance();

  const Simulator& simulator_;
  std::unique_ptr<Allocator> allocator_;
  RewardOptions rewards_;
  PauseOptions pauses_;
  RandomStream random_{0};
  bool failed_ = false;
  bool pausing_ = false;    ///< this episode has pauses
  Tick paused_ = 0;         ///< so far
  Tick horizon_added_ = 0;  ///< room for them
  SimulationState state_;
};

}  // namespace linewright
