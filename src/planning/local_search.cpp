#include "local_search.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace linewright::planning {
namespace {

using Offset = std::ptrdiff_t;

// Shares of the changes that are tried, where they are allowed; the rest is another task.
constexpr double kAgentShare = 0.3;
constexpr double kWaitShare = 0.3;

/// 0, 1, 2, ... with falling probability, each `share` of the one before.
std::size_t geometric(RandomStream& random, double share) {
  std::size_t count = 0;
  while (count < 64 && random.uniform() < share) ++count;
  return count;
}

/// The n-th task of the set.
TaskId nth(const TaskSet& tasks, std::size_t n) {
  TaskId found;
  tasks.each([&](TaskId task) {
    if (n-- == 0) found = task;
  });
  return found;
}

}  // namespace

LocalSearch::LocalSearch(FuturePlayer& player, Planner& base, bool free_agents)
    : player_(player), base_(base), free_agents_(free_agents) {}

void LocalSearch::begin(const Future& from, const Choices* first) {
  first_ = first;
  const std::size_t decisions = from.decisions.size();
  current_.decisions = from.decisions;
  current_.cost = from.cost;
  if (current_.before.size() < decisions) current_.before.resize(decisions);
  std::copy_n(from.before.begin(), decisions, current_.before.begin());
  best_ = current_;
}

Choices LocalSearch::choices_at(std::size_t position) const {
  if (position == 0 && first_ != nullptr) return *first_;
  return all_choices(player_.simulator(), current_.before[position]);
}

bool LocalSearch::step(RandomStream& random) {
  const std::size_t count = current_.decisions.size();
  if (count == 0) return false;
  // Positions at which nothing else is possible are common: then the next one that has something.
  std::size_t position = random.below(count);
  std::size_t tried = 0;
  while (!change(position, random)) {
    if (++tried == 2 * count) return false;
    position = tried < count ? random.below(count) : (position + 1) % count;
  }
  const double up = -temperature_ * std::log(1.0 - random.uniform());
  const Cost bound = current_.cost + static_cast<Cost>(up);
  if (player_.is_random()) {
    // Its cost is known for all random numbers only from the start.
    wishes_.insert(wishes_.begin(), current_.decisions.begin(),
                   current_.decisions.begin() + static_cast<Offset>(position));
    position = 0;
  }
  const Choices* first = position == 0 ? first_ : nullptr;
  player_.play(current_.before[position], first, wishes_, base_, bound, candidate_);
  if (candidate_.cost <= bound) accept(position);
  return true;
}

void LocalSearch::accept(std::size_t position) {
  const std::size_t count = candidate_.decisions.size();
  current_.decisions.resize(position);
  current_.decisions.insert(current_.decisions.end(), candidate_.decisions.begin(),
                            candidate_.decisions.end());
  if (current_.before.size() < position + count) current_.before.resize(position + count);
  for (std::size_t i = 0; i < count; ++i) {
    std::swap(current_.before[position + i], candidate_.before[i]);
  }
  current_.cost = candidate_.cost;
  if (current_.cost < best_.cost) best_ = current_;
}

bool LocalSearch::change(std::size_t position, RandomStream& random) {
  const double draw = random.uniform();
  const Wish& wish = current_.decisions[position];
  if (free_agents_ && draw < kAgentShare) return change_agent(position, random);
  if (player_.may_wait() && draw > 1.0 - kWaitShare) {
    if (!wish.insist) return insist_on_later(position, random);
    copy_rest(position);
    wishes_[0].insist = false;
    return true;
  }
  return change_task(position, random);
}

void LocalSearch::copy_rest(std::size_t position) {
  wishes_.assign(current_.decisions.begin() + static_cast<Offset>(position),
                 current_.decisions.end());
}

bool LocalSearch::change_task(std::size_t position, RandomStream& random) {
  TaskSet others = choices_at(position).tasks;
  others.erase(current_.decisions[position].task);
  const std::size_t count = others.size();
  if (count == 0) return false;
  Wish chosen{.task = nth(others, random.below(count))};
  copy_rest(position);
  const auto later = std::find_if(wishes_.begin() + 1, wishes_.end(),
                                  [&](const Wish& wish) { return wish.task == chosen.task; });
  if (later != wishes_.end()) {
    chosen = *later;
    chosen.insist = false;
    wishes_.erase(later);
  }
  // What it takes the place of comes at any time later.
  const Wish displaced = wishes_[0];
  wishes_[0] = chosen;
  const std::size_t back = 1 + random.below(wishes_.size());
  wishes_.insert(wishes_.begin() + static_cast<Offset>(back), displaced);
  return true;
}

bool LocalSearch::insist_on_later(std::size_t position, RandomStream& random) {
  const std::size_t later = position + 1 + geometric(random, 0.6);
  if (later >= current_.decisions.size()) return false;
  copy_rest(position);
  const auto chosen = wishes_.begin() + static_cast<Offset>(later - position);
  std::rotate(wishes_.begin(), chosen, chosen + 1);
  wishes_[0].insist = true;
  return true;
}

std::optional<std::int16_t> LocalSearch::other_member(const SimulationState& state,
                                                      const Wish& wish, std::size_t slot, bool busy,
                                                      RandomStream& random) {
  const Simulator& simulator = player_.simulator();
  const CrewSlot& crew = simulator.line().tasks[wish.task.index()].crew[slot];
  members_.clear();
  const std::size_t count = crew.worker ? state.workers.size() : state.carriers.size();
  for (std::size_t id = 0; id < count; ++id) {
    const auto member = static_cast<std::int16_t>(id);
    if (member == wish.members[slot]) continue;
    const bool fits = crew.worker ? state.workers[id].kind == crew.worker->value &&
                                        (busy || state.workers[id].free())
                                  : simulator.carrier_fits(state, crew, CarrierId(id)) ||
                                        (busy && crew.wanted != CarrierWanted::kBerth &&
                                         state.carriers[id].kind == crew.carrier->value);
    if (fits) members_.push_back(member);
  }
  if (members_.empty()) return std::nullopt;
  return members_[random.below(members_.size())];
}

bool LocalSearch::change_agent(std::size_t position, RandomStream& random) {
  const SimulationState& state = current_.before[position];
  Wish wish = current_.decisions[position];
  if (wish.named && random.uniform() < 0.2) {
    copy_rest(position);
    wishes_[0].named = false;
    return true;
  }
  if (!wish.named) {
    if (!state.is_selectable(wish.task)) return false;
    wish.members = player_.allocator().allocate(state, wish.task).members;
    wish.named = true;
  }
  const auto& crew = player_.simulator().line().tasks[wish.task.index()].crew;
  const std::size_t slot = random.below(crew.size());
  const bool busy = player_.may_wait() && random.uniform() < 0.5;
  const auto member = other_member(state, wish, slot, busy, random);
  if (!member) return false;
  // Somebody who has another part in it already changes places.
  for (std::size_t other = 0; other < crew.size(); ++other) {
    if (crew[other].worker.has_value() == crew[slot].worker.has_value() &&
        wish.members[other] == *member) {
      wish.members[other] = wish.members[slot];
    }
  }
  wish.members[slot] = *member;
  wish.insist = wish.insist || busy;
  copy_rest(position);
  wishes_[0] = wish;
  return true;
}

}  // namespace linewright::planning
