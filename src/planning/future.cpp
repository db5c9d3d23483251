#include "future.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "linewright/allocation/advance.hpp"

namespace linewright::planning {
namespace {

constexpr std::size_t kAskEvery = 16;  ///< decisions between two questions whether to give up

}  // namespace

FuturePlayer::FuturePlayer(const Simulator& simulator, PlayerOptions options)
    : simulator_(simulator),
      options_(std::move(options)),
      may_wait_(options_.wait || simulator.line().allow_wait),
      allocator_(make_allocator(options_.allocator, simulator)) {}

bool FuturePlayer::possible(const Wish& wish, Assignment& assignment) const {
  assignment.task = wish.task;
  assignment.members = wish.members;
  return simulator_.can_assign(state_, assignment);
}

FuturePlayer::Step FuturePlayer::take(Wish wish, Future& result) {
  Assignment assignment(wish.task);
  if (!wish.named || !possible(wish, assignment)) {
    assignment = allocator_->allocate(state_, wish.task);
    wish.named = false;
  }
  wish.insist = waited_;
  wish.members = assignment.members;
  result.decisions.push_back(wish);
  simulator_.assign(state_, assignment);
  return Step::kTaken;
}

FuturePlayer::Step FuturePlayer::decide(const Choices& choices, std::vector<Wish>& wishes,
                                        Planner& base, Future& result) {
  const auto wait = [&] { return simulator_.wait(state_) ? Step::kWaited : Step::kStuck; };
  for (std::size_t i = 0; i < wishes.size(); ++i) {
    const Wish& wish = wishes[i];
    const bool insists = wish.insist && may_wait_;
    if (!choices.tasks.contains(wish.task)) {
      if (insists) return wait();
      continue;
    }
    if (Assignment assignment; insists && wish.named && !possible(wish, assignment)) return wait();
    const Wish granted = wish;
    wishes.erase(wishes.begin() + static_cast<std::ptrdiff_t>(i));
    return take(granted, result);
  }
  const Decision decision = base.decide(state_, choices);
  if (!decision.task) return wait();
  Wish wish{.task = *decision.task};
  if (decision.assignment) {
    wish.named = true;
    wish.members = decision.assignment->members;
  }
  return take(wish, result);
}

void FuturePlayer::play(const SimulationState& start, const Choices* first,
                        std::vector<Wish>& wishes, Planner& base, Cost bound, Future& result) {
  if (!is_random()) {
    play_one(start, first, wishes, base, bound, result);
    return;
  }
  const std::vector<Wish> all = wishes;
  Cost sum = 0;
  for (std::size_t s = 0; s < options_.samples; ++s) {
    sample_wishes_ = all;
    allocator_->reset(RandomStream::derive(seed_, "future", s).next());
    play_one(start, first, sample_wishes_, base, kWorst, s == 0 ? result : sample_);
    sum += s == 0 ? result.cost : sample_.cost;
  }
  result.cost = sum / static_cast<Cost>(options_.samples);
}

void FuturePlayer::play_one(const SimulationState& start, const Choices* first,
                            std::vector<Wish>& wishes, Planner& base, Cost bound, Future& result) {
  result.decisions.clear();
  result.cost = kWorst;
  state_ = start;
  horizon_ = start.horizon;
  // Nothing later than the bound is of interest: the simulator stops there by itself.
  if (bound < kUnfinished) {
    state_.horizon = static_cast<Tick>(std::min<Cost>(bound, state_.horizon));
  }
  waited_ = false;
  for (std::size_t steps = 1;
       advance_and_join(simulator_, state_, *allocator_) == RunStatus::kDecision; ++steps) {
    if (steps % kAskEvery == 0 && options_.give_up && options_.give_up()) return;
    const std::size_t next = result.decisions.size();
    if (!waited_) {
      if (result.before.size() <= next) result.before.emplace_back();
      result.before[next] = state_;
      result.before[next].horizon = horizon_;
    }
    const bool is_first = first != nullptr && state_.now == start.now;
    const Step step =
        decide(is_first ? *first : all_choices(simulator_, state_), wishes, base, result);
    waited_ = step == Step::kWaited;
    if (step == Step::kStuck) break;
  }
  result.cost = cost_of_end();
}

Cost FuturePlayer::cost_of_end() const {
  if (state_.status == RunStatus::kFinished) return state_.now;
  if (state_.horizon < horizon_) return kWorst;  // beyond the bound
  constexpr double kSteps = 1 << 20;
  const double missing = 1.0 - simulator_.progress(state_);
  return kUnfinished + static_cast<Cost>(missing * kSteps);
}

}  // namespace linewright::planning
