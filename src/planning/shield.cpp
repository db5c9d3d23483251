#include "linewright/planning/shield.hpp"

#include <algorithm>
#include <bit>
#include <numeric>

#include "linewright/allocation/advance.hpp"
#include "linewright/base/tick.hpp"
#include "reach.hpp"
#include "search_futures.hpp"

namespace linewright {
namespace {

constexpr std::size_t kLongestRollout = 20'000;  // decisions and waits
constexpr std::size_t kMostKnown = 500'000;      // states remembered in one run
constexpr std::size_t kFirstRules = 4;           // tried before any search
constexpr std::size_t kFewStates = 300;          // of the search before the other rules
constexpr std::uint64_t kSeed = 1;               // of the rules that are tried

}  // namespace

Shield::Shield(const Simulator& simulator, const ShieldOptions& options)
    : simulator_(simulator),
      options_(options),
      allocator_(make_allocator("sap", simulator)),
      reach_(std::make_unique<Reach>(simulator)),
      random_(0) {
  reset();
}

Shield::~Shield() = default;

void Shield::reset() {
  statistics_ = {};
  known_.clear();
  random_ = RandomStream::derive(kSeed, "shield");
  rules_.clear();
  // First by number: as soon as possible, and only when nothing else is under way.
  const std::size_t tasks = simulator_.line().tasks.size();
  Rule rule;
  for (std::size_t t = 0; t < tasks; ++t) rule.order.emplace_back(t);
  rule.lazy.assign(tasks, false);
  rules_.push_back(rule);
  rule.lazy.assign(tasks, true);
  rules_.push_back(std::move(rule));
}

Shield::Verdict Shield::judge(const SimulationState& after) {
  ++statistics_.judged;
  judged_ = after;
  judged_.horizon = kMaxTicks;  // whether it can be finished is not a question of time
  if (judged_.status == RunStatus::kHorizon) judged_.status = RunStatus::kRunning;
  const Verdict verdict = look(judged_);
  if (verdict == Verdict::kFatal) ++statistics_.fatal;
  if (verdict == Verdict::kUnknown) ++statistics_.unknown;
  return verdict;
}

Shield::Verdict Shield::look(SimulationState& state) {
  const RunStatus status = advance_and_join(simulator_, state, *allocator_);
  if (status == RunStatus::kFinished) return Verdict::kSafe;
  if (status != RunStatus::kDecision) return Verdict::kFatal;
  const StateKey key = state_key(simulator_, state, scratch_);
  if (const auto known = known_.find(key); known != known_.end()) {
    ++statistics_.remembered;
    return known->second;
  }
  if (known_.size() > kMostKnown) known_.clear();
  const Verdict verdict = find_out(state);
  known_[key] = verdict;
  return verdict;
}

/// Cheap looks first: most states are safe by one of the first rules, most fatal ones have few
/// futures.
Shield::Verdict Shield::find_out(const SimulationState& state) {
  if (!reach_->may_finish(state)) return Verdict::kFatal;
  if (some_rule_finishes(state, 0, std::min(kFirstRules, options_.rollouts))) return Verdict::kSafe;
  const Verdict few = search(state, std::min(kFewStates, options_.max_states));
  if (few != Verdict::kUnknown) return few;
  if (some_rule_finishes(state, kFirstRules, options_.rollouts)) return Verdict::kSafe;
  return search(state, options_.max_states);
}

Shield::Rule Shield::next_rule() {
  const std::size_t tasks = simulator_.line().tasks.size();
  Rule rule;
  for (std::size_t t = 0; t < tasks; ++t) rule.order.emplace_back(t);
  for (std::size_t t = tasks; t > 1; --t)
    std::swap(rule.order[t - 1], rule.order[random_.below(t)]);
  for (std::size_t t = 0; t < tasks; ++t) rule.lazy.push_back(random_.below(2) == 1);
  return rule;
}

bool Shield::some_rule_finishes(const SimulationState& from, std::size_t first, std::size_t end) {
  for (std::size_t r = first; r < end; ++r) {
    while (r >= rules_.size()) rules_.push_back(next_rule());
    state_ = from;
    if (!finishes(state_, rules_[r])) continue;
    std::rotate(rules_.begin(), rules_.begin() + static_cast<std::ptrdiff_t>(r),
                rules_.begin() + static_cast<std::ptrdiff_t>(r) + 1);
    return true;
  }
  return false;
}

bool Shield::finishes(SimulationState& state, const Rule& rule) {
  ++statistics_.rollouts;
  trail_.clear();
  const auto first = [&](bool lazy) -> std::optional<TaskId> {
    for (const TaskId task : rule.order) {
      if (rule.lazy[task.index()] == lazy && state.is_selectable(task)) return task;
    }
    return std::nullopt;
  };
  bool alive = false;
  StateKey mark;
  for (std::size_t step = 0; step < kLongestRollout; ++step) {
    const RunStatus status = advance_and_join(simulator_, state, *allocator_);
    alive = status == RunStatus::kFinished;
    if (status != RunStatus::kDecision) break;
    trail_.push_back(state_key(simulator_, state, scratch_));
    if (step > 0 && trail_.back() == mark) break;  // it goes round in circles
    if (std::has_single_bit(step + 1)) mark = trail_.back();
    if (const auto known = known_.find(trail_.back()); known != known_.end()) {
      if (known->second != Verdict::kUnknown) {
        alive = known->second == Verdict::kSafe;
        break;
      }
    }
    std::optional<TaskId> task = first(false);
    if (!task && simulator_.wait(state)) continue;
    if (!task) task = first(true);
    simulator_.assign(state, allocator_->allocate(state, *task));
  }
  if (!alive) return false;
  // The run may follow this future without another look.
  for (const StateKey& key : trail_) known_[key] = Verdict::kSafe;
  return true;
}

Shield::Verdict Shield::search(const SimulationState& start, std::size_t most) {
  ++statistics_.searches;
  const auto known = [&](const SimulationState& state, const StateKey& key) -> std::optional<bool> {
    const auto found = known_.find(key);
    if (found != known_.end() && found->second != Verdict::kUnknown) {
      return found->second == Verdict::kSafe;
    }
    if (!reach_->may_finish(state)) return false;
    ++statistics_.states;
    return std::nullopt;
  };
  const planning::SearchedFutures futures = planning::search_futures(
      simulator_, *allocator_, start,
      {.order = rules_[0].order, .most = most, .give_up = {}, .known = known});
  if (!futures.finishes) return Verdict::kUnknown;
  if (*futures.finishes) return Verdict::kSafe;
  for (const StateKey& key : futures.seen) known_[key] = Verdict::kFatal;
  return Verdict::kFatal;
}

}  // namespace linewright
