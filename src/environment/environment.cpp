#include "linewright/environment/environment.hpp"

#include <algorithm>
#include <stdexcept>

#include "linewright/allocation/advance.hpp"

namespace linewright {

Environment::Environment(const Simulator& simulator, const std::string& allocator,
                         const RewardOptions& rewards, const PauseOptions& pauses)
    : simulator_(simulator),
      allocator_(make_allocator(allocator, simulator)),
      rewards_(rewards),
      pauses_(pauses) {}

bool Environment::reset(const RunSetup& setup, std::uint64_t seed) {
  allocator_->reset(seed);
  random_ = RandomStream::derive(seed, "pauses");
  pausing_ = pauses_.episodes > 0.0 && random_.uniform() < pauses_.episodes;
  paused_ = horizon_added_ = 0;
  failed_ = false;
  if (pausing_) {
    RunSetup longer = setup;
    constexpr Tick kRoom = 10;  // times the horizon: more than pauses ever take of it
    horizon_added_ = std::min(setup.horizon, kMaxTicks / kRoom) * (kRoom - 1);
    longer.horizon += horizon_added_;
    simulator_.reset(state_, longer);
  } else {
    simulator_.reset(state_, setup);
  }
  return advance() == RunStatus::kDecision;
}

RunStatus Environment::advance() {
  if (advance_and_join(simulator_, state_, *allocator_) != RunStatus::kDecision || !pausing_ ||
      random_.uniform() >= pauses_.decisions) {
    return state_.status;
  }
  const Tick before = state_.now;
  const Tick until = before + random_.between(1, pauses_.most);
  while (!state_.ended() && state_.now < until &&
         simulator_.advance_to(state_, until) == RunStatus::kJoin) {
    bind_joiner(simulator_, state_, *allocator_);
  }
  paused_ += state_.now - before;
  return advance_and_join(simulator_, state_, *allocator_);
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
  const Tick paused_before = paused_;
  if (!state_.ended()) advance();
  StepResult result = rewarded(before + paused_ - paused_before, progress_before);
  result.paused = paused_ > paused_before;
  return result;
}

StepResult Environment::rewarded(Tick before, double progress_before) {
  StepResult result{.ended = state_.ended(), .success = state_.status == RunStatus::kFinished};
  // Behind the horizon, pauses left out, a run has failed as well.
  if (pausing_ && !result.ended && state_.now - paused_ >= horizon()) {
    simulator_.advance_to(state_, state_.horizon + 1);
    result.ended = true;
  }
  if (pausing_ && result.success && state_.now - paused_ > horizon()) result.success = false;
  failed_ = result.ended && !result.success;
  const Tick until = failed_ ? std::max(before, horizon() + paused_) : state_.now;
  double reward = -rewards_.eta1 * (until - before) +
                  rewards_.eta3 * (simulator_.progress(state_) - progress_before) +
                  rewards_.decision_bonus;
  if (result.ended) reward += result.success ? rewards_.eta2 : -rewards_.eta2;
  result.reward = static_cast<float>(reward);
  return result;
}

Tick Environment::makespan() const { return failed_ ? horizon() : state_.now - paused_; }

}  // namespace linewright
