#include "linewright/environment/environment.hpp"

#include <stdexcept>

#include "linewright/allocation/advance.hpp"

namespace linewright {

Environment::Environment(const Simulator& simulator, const std::string& allocator,
                         const RewardOptions& rewards)
    : simulator_(simulator), allocator_(make_allocator(allocator, simulator)), rewards_(rewards) {}

bool Environment::reset(const RunSetup& setup, std::uint64_t seed) {
  allocator_->reset(seed);
  simulator_.reset(state_, setup);
  return advance_and_join(simulator_, state_, *allocator_) == RunStatus::kDecision;
}

StepResult Environment::step(std::size_t action) {
  const Tick before = state_.now;
  const double progress_before = simulator_.progress(state_);
  if (action < simulator_.line().tasks.size()) {
    if (!state_.is_selectable(TaskId(action)) ||
        !simulator_.assign(state_, allocator_->allocate(state_, TaskId(action)))) {
      throw std::logic_error("the environment was given an action that is not selectable");
    }
  } else if (!simulator_.wait(state_)) {
    simulator_.advance_to(state_, state_.horizon + 1);  // nothing could ever happen
  }
  if (!state_.ended()) advance_and_join(simulator_, state_, *allocator_);
  return rewarded(before, progress_before);
}

StepResult Environment::rewarded(Tick before, double progress_before) {
  StepResult result{.ended = state_.ended(), .success = state_.status == RunStatus::kFinished};
  const Tick until = result.ended && !result.success ? state_.horizon : state_.now;
  double reward = -rewards_.eta1 * (until - before) +
                  rewards_.eta3 * (simulator_.progress(state_) - progress_before);
  if (result.ended) reward += result.success ? rewards_.eta2 : -rewards_.eta2;
  result.reward = static_cast<float>(reward);
  return result;
}

Tick Environment::makespan() const {
  return state_.status == RunStatus::kFinished ? state_.now : state_.horizon;
}

}  // namespace linewright
