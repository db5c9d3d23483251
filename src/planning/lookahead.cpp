#include "linewright/planning/lookahead.hpp"

#include <algorithm>
#include <atomic>
#include <utility>
#include <vector>

#include "linewright/base/diagnostic.hpp"
#include "linewright/base/worker_pool.hpp"
#include "search_chain.hpp"

namespace linewright {
namespace {

using planning::Cooling;
using planning::Cost;
using planning::Future;
using planning::FuturePlayer;
using planning::kChainsOfRollouts;
using planning::kUnfinished;
using planning::kWorst;
using planning::SearchChain;
using planning::Wish;

// Of each decision's search: what was best on the duct line after 60 and 400 futures per decision.
// With agents and waiting there is more to choose from, and a cold end is better.
constexpr Cooling kTasks{.hot = 40.0, .cold = 15.0};
constexpr Cooling kTasksAndMore{.hot = 40.0, .cold = 1.0};

class LookaheadPlanner final : public Planner {
 public:
  LookaheadPlanner(const Simulator& simulator, const LookaheadOptions& options,
                   const PlannerContext& context)
      : options_(options),
        context_(context),
        cooling_(options.free_agents || options.wait || simulator.line().allow_wait ? kTasksAndMore
                                                                                    : kTasks),
        pool_(options.threads) {
    for (std::size_t c = 0; c < options.chains; ++c) {
      chains_.push_back(std::make_unique<SearchChain>(
          simulator, SearchChain::Options{options.base, options.free_agents, options.wait}, context,
          [this] { return out_of_time(); }));
    }
    if (!options.base.empty()) return;
    seeds_ = planning::simple_planners(simulator, context);
  }

  void reset(std::uint64_t seed) override {
    seed_ = seed;
    decisions_ = 0;
    plan_.clear();
    for (const auto& chain : chains_) chain->base->reset(seed);
    for (const auto& planner : seeds_) planner->reset(seed);
  }

  Decision decide(const SimulationState& state, const Choices& choices) override {
    deadline_ = options_.budget_ns > 0 ? context_.now_ns() + options_.budget_ns : 0;
    // Not the random numbers of the run itself: these are unknown.
    const std::uint64_t future = RandomStream::derive(seed_, "futures", decisions_).next();
    for (const auto& chain : chains_) chain->player.reseed(future);
    plan_cost_ = kWorst;
    find_incumbent(state, choices);
    if (incumbent_.cost < kWorst) {
      improve(choices);
      ++decisions_;
    }
    return first_of_plan(state, choices);
  }

 private:
  [[nodiscard]] bool out_of_time() const {
    if (context_.cancel != nullptr && context_.cancel->requested()) return true;
    return deadline_ != 0 && context_.now_ns() >= deadline_;
  }

  /// The rest of the plan, played from where the run really stands; at the start of a run the best
  /// of the base planners' futures.
  void find_incumbent(const SimulationState& state, const Choices& choices) {
    FuturePlayer& player = chains_[0]->player;
    incumbent_.cost = kWorst;
    used_ = 0;
    const auto consider = [&](Planner& base) {
      player.play(state, &choices, wishes_, base, incumbent_.cost, trial_);
      ++used_;
      if (trial_.cost < incumbent_.cost) std::swap(trial_, incumbent_);
    };
    wishes_ = plan_;
    consider(*chains_[0]->base);
    if (decisions_ > 0) return;
    for (const auto& planner : seeds_) {
      if (out_of_time()) return;
      wishes_.clear();
      consider(*planner);
    }
  }

  void improve(const Choices& choices) {
    const std::size_t left = options_.rollouts > used_ ? options_.rollouts - used_ : 0;
    const std::int64_t begun = deadline_ != 0 ? context_.now_ns() : 0;
    pool_.run(chains_.size(), [&](std::size_t begin, std::size_t end, std::size_t /*thread*/) {
      for (std::size_t c = begin; c < end; ++c) {
        chains_[c]->random =
            RandomStream::derive(seed_, "lookahead", decisions_ * chains_.size() + c);
        chains_[c]->search.begin(incumbent_, &choices);
      }
      if (options_.rollouts > 0) {
        for (std::size_t c = begin; c < end; ++c) {
          spend_all(*chains_[c], left / chains_.size() + (c < left % chains_.size() ? 1 : 0));
        }
        return;
      }
      // In turn, so that each gets as much of the time.
      while (!out_of_time()) {
        const double temperature = cooling_.at(static_cast<double>(context_.now_ns() - begun) /
                                               static_cast<double>(deadline_ - begun));
        bool any = false;
        for (std::size_t c = begin; c < end; ++c) {
          chains_[c]->search.set_temperature(temperature);
          any |= spend(*chains_[c], 4);
        }
        if (!any) return;
      }
    });
    plan_ = incumbent_.decisions;
    plan_cost_ = incumbent_.cost;
    for (const auto& chain : chains_) {
      if (chain->search.best().cost >= plan_cost_) continue;
      plan_cost_ = chain->search.best().cost;
      plan_ = chain->search.best().decisions;
    }
  }

  void spend_all(SearchChain& chain, std::size_t rollouts) const {
    for (std::size_t r = 0; r < rollouts; ++r) {
      chain.search.set_temperature(
          cooling_.at(static_cast<double>(r) / static_cast<double>(rollouts)));
      if (!spend(chain, 1)) return;
    }
  }

  bool spend(SearchChain& chain, std::size_t rollouts) const {
    for (std::size_t r = 0; r < rollouts; ++r) {
      if (out_of_time()) return false;
      if (!chain.search.step(chain.random)) return false;
    }
    return true;
  }

  /// As the base planner where the plan is at its end, or (never played to the end in time) does
  /// not fit the state.
  Decision first_of_plan(const SimulationState& state, const Choices& choices) {
    if (plan_.empty()) return chains_[0]->base->decide(state, choices);
    const Wish wish = plan_.front();
    Decision decision;
    if (plan_cost_ < kUnfinished) decision.planned_end = static_cast<Tick>(plan_cost_);
    decision.task = wish.task;
    if (wish.named) {
      decision.assignment = Assignment(wish.task);
      decision.assignment->members = wish.members;
    }
    const Simulator& simulator = chains_[0]->player.simulator();
    const bool possible =
        choices.tasks.contains(wish.task) &&
        (!decision.assignment || simulator.can_assign(state, *decision.assignment));
    if (!possible && wish.insist) return {.planned_end = decision.planned_end};
    plan_.erase(plan_.begin());
    return possible ? decision : chains_[0]->base->decide(state, choices);
  }

  LookaheadOptions options_;
  PlannerContext context_;
  Cooling cooling_;
  WorkerPool pool_;
  std::vector<std::unique_ptr<SearchChain>> chains_;
  std::vector<std::unique_ptr<Planner>> seeds_;
  std::uint64_t seed_ = 0;
  std::uint64_t decisions_ = 0;
  std::int64_t deadline_ = 0;  ///< 0: none
  std::vector<Wish> plan_;     ///< the best future known, from the decision to come
  Cost plan_cost_ = kWorst;
  std::vector<Wish> wishes_;  ///< scratch
  Future incumbent_;
  Future trial_;
  std::size_t used_ = 0;  ///< futures played for this decision so far
};

}  // namespace

std::unique_ptr<Planner> make_lookahead_planner(const Simulator& simulator,
                                                const LookaheadOptions& options,
                                                const PlannerContext& context) {
  if (options.budget_ns > 0 && !context.now_ns) {
    throw ScenarioError({}, "lookahead: there is no clock for a budget in time",
                        "give a number of rollouts, such as lookahead:200r");
  }
  LookaheadOptions complete = options;
  if (complete.threads == 0) complete.threads = std::max<std::size_t>(1, context.threads);
  if (complete.chains == 0) {
    complete.chains = complete.rollouts > 0 ? kChainsOfRollouts : complete.threads;
  }
  return std::make_unique<LookaheadPlanner>(simulator, complete, context);
}

}  // namespace linewright
