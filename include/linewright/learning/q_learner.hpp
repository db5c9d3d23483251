#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "linewright/learning/learner_state.hpp"
#include "linewright/network/network.hpp"
#include "linewright/training/replay_buffer.hpp"

namespace linewright {

/// How a QLearner learns.
struct QLearnerOptions {
  double adam_epsilon = 1.5e-4;
  double average = 0.0;         ///< share of the running mean of the weights that an update keeps
  double gradient_clip = 10.0;  ///< largest norm of the gradient of all parameters together
  bool double_q =
      true;  ///< the online network chooses the next action, the target network rates it
  /// Targets are at least what was reached from the state to the end of its episode
  /// (ReplayBatch::to_end): a bound from below where the same decisions lead to the same end.
  bool return_bound = false;
  std::size_t threads = 1;  ///< that share the batch; 0: one per core. Never changes a result
};

/// Q-learning on batches out of a replay buffer (paper, eq. 8 and Algorithm 1): online and target
/// network in LibTorch, double-Q targets, Adam. The same for any number of threads.
class QLearner {
 public:
  /// Starts from `tensors` (initial_tensors or a policy's). Throws ScenarioError when they do not
  /// fit.
  QLearner(const ObservationSpec& spec, const NetworkOptions& network, const TensorMap& tensors,
           const QLearnerOptions& options, std::uint64_t seed);
  ~QLearner();
  QLearner(const QLearner&) = delete;
  QLearner& operator=(const QLearner&) = delete;

  /// One step of gradient descent on mean(weight * TD error^2). `td_errors` receives target - q by
  /// row of the batch. When the
  /// report is not finite, nothing was changed.
  UpdateReport update(const ReplayBatch& batch, double learning_rate,
                      std::vector<float>& td_errors);

  /// Makes the online network the target network.
  void copy_target();

  /// The online network's tensors.
  [[nodiscard]] TensorMap tensors() const;
  /// The running mean of its weights where the options ask for one, else tensors().
  [[nodiscard]] TensorMap averaged_tensors() const;

  [[nodiscard]] LearnerState state() const;
  /// Throws std::invalid_argument when the sizes are not this learner's.
  void restore(const LearnerState& state);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace linewright
