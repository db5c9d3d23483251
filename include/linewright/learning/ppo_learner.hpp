#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "linewright/learning/learner_state.hpp"
#include "linewright/network/network.hpp"

namespace linewright {

/// How a PpoLearner learns (Schulman et al., Proximal Policy Optimization, 2017).
struct PpoLearnerOptions {
  double adam_epsilon = 1.5e-4;
  double average = 0.0;  ///< share of the running mean of the weights that an update keeps
  double gradient_clip = 10.0;
  double clip = 0.2;               ///< of the ratio of probabilities
  double entropy = 0.01;           ///< weight of the entropy bonus
  double value_coefficient = 0.5;  ///< weight of the critic's squared error
  std::size_t threads = 1;  ///< that share the batch; 0: one per core. Never changes a result
};

/// Decisions to learn from, row by row.
struct PpoBatch {
  std::size_t size = 0;
  std::vector<float> features;           ///< [size x features]
  std::vector<std::uint8_t> present;     ///< [size x tokens]
  std::vector<std::uint8_t> selectable;  ///< [size x actions]
  std::vector<std::int64_t> action;
  std::vector<float> log_probability;  ///< of the action, when it was taken
  std::vector<float> advantage;
  std::vector<float> returns;  ///< what the critic should have said
  std::vector<float> weight;   ///< how much the row counts; mean about 1
};

/// Actor and critic on one trunk, in LibTorch. The same for any number of threads.
class PpoLearner {
 public:
  /// Starts from `tensors`; `network` has `actor_critic`. Throws ScenarioError when they do not
  /// fit.
  PpoLearner(const ObservationSpec& spec, const NetworkOptions& network, const TensorMap& tensors,
             const PpoLearnerOptions& options);
  ~PpoLearner();
  PpoLearner(const PpoLearner&) = delete;
  PpoLearner& operator=(const PpoLearner&) = delete;

  /// One step of gradient descent on the clipped surrogate, with the noise that the decisions were
  /// made with. When the report is not finite, nothing was changed.
  UpdateReport update(const PpoBatch& batch, const Noise* noise, double learning_rate);

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
