#include "linewright/planning/solve.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "linewright/allocation/allocator.hpp"
#include "linewright/base/diagnostic.hpp"
#include "linewright/base/random.hpp"
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

// Rounds of annealing: each is longer than the one before, so that short budgets end cold as well.
constexpr std::size_t kFirstRound = 1'000;
constexpr std::size_t kLongestRound = 64'000;
constexpr Cooling kRound{.hot = 25.0, .cold = 1.0};

/// A chain that goes on in rounds.
struct Chain : SearchChain {
  using SearchChain::SearchChain;

  Future home;  ///< what its next round begins with
  std::size_t played = 0;
};

class Solver {
 public:
  Solver(const Simulator& simulator, const RunSetup& setup, const SolveOptions& options,
         const PlannerContext& context)
      : simulator_(simulator), options_(options), context_(context) {
    refuse_bad_options();
    pool_ = std::make_unique<WorkerPool>(context.threads);
    std::size_t chains = options.chains;
    if (chains == 0) chains = options.rollouts > 0 ? kChainsOfRollouts : pool_->size();
    for (std::size_t c = 0; c < chains; ++c) {
      chains_.push_back(std::make_unique<Chain>(
          simulator, SearchChain::Options{{}, options.free_agents, options.wait}, context,
          [this] { return out_of_time(); }));
      chains_[c]->random = RandomStream::derive(options.seed, "solve", c);
    }
    if (options.budget_ns > 0) begun_ = context.now_ns();
    check_setup(simulator.line(), setup);
    simulator.reset(start_, setup);
  }

  Solution run(const std::function<void(const SolveProgress&)>& progress) {
    warm_start();
    if (best_.cost == kWorst) {
      throw ScenarioError({}, "no future of this run comes to an end within the budget",
                          "give it more time, or a horizon (--horizon TICKS)");
    }
    for (const auto& chain : chains_) chain->home = best_;
    report(progress);
    for (std::size_t round = kFirstRound; !out_of_budget();
         round = std::min(round * 2, kLongestRound)) {
      if (!anneal(round)) break;
      report(progress);
    }
    return solution();
  }

 private:
  void refuse_bad_options() const {
    if (options_.budget_ns <= 0 && options_.rollouts == 0) {
      throw ScenarioError({}, "solve: a budget of zero leaves nothing to search with",
                          "give a time above zero, such as --budget 60s");
    }
    if (options_.budget_ns > 0 && !context_.now_ns) {
      throw ScenarioError({}, "solve: there is no clock for a budget in time",
                          "give a number of rollouts");
    }
    if (make_allocator(context_.allocator, simulator_)->draws()) {
      throw ScenarioError(
          {}, "solve: allocator '" + context_.allocator + "' draws at random: no plan is certain",
          "use another allocator");
    }
  }

  [[nodiscard]] bool out_of_time() const {
    if (context_.cancel != nullptr && context_.cancel->requested()) return true;
    return options_.budget_ns > 0 && context_.now_ns() - begun_ >= options_.budget_ns;
  }
  [[nodiscard]] std::size_t played() const {
    std::size_t count = warm_played_;
    for (const auto& chain : chains_) count += chain->played;
    return count;
  }
  [[nodiscard]] bool out_of_budget() const {
    return out_of_time() || (options_.rollouts > 0 && played() >= options_.rollouts);
  }

  /// The best of the runs of all other planners.
  void warm_start() {
    std::vector<std::pair<std::string, std::unique_ptr<Planner>>> planners;
    for (const std::string& name : options_.warm_starts) {
      planners.emplace_back(name, PlannerRegistry::make(name, simulator_, context_));
    }
    for (auto& planner : planning::simple_planners(simulator_, context_)) {
      planners.emplace_back("a dispatching rule", std::move(planner));
    }
    FuturePlayer& player = chains_[0]->player;
    Future trial;
    for (const auto& [name, planner] : planners) {
      if (best_.cost < kWorst && out_of_budget()) break;
      planner->reset(options_.seed);
      std::vector<Wish> nothing;
      player.play(start_, nullptr, nothing, *planner, kWorst, trial);
      ++warm_played_;
      if (trial.cost >= best_.cost) continue;
      std::swap(best_, trial);
      warm_start_ = name;
    }
    warm_cost_ = best_.cost;
  }

  /// One round of all chains. False: there is nothing to change in any plan.
  bool anneal(std::size_t steps) {
    if (options_.rollouts > 0) {
      const std::size_t left = options_.rollouts - std::min(played(), options_.rollouts);
      steps = std::min(steps, std::max<std::size_t>(1, left / chains_.size()));
    }
    std::vector<std::uint8_t> moved(chains_.size(), 0);
    pool_->run(chains_.size(), [&](std::size_t begin, std::size_t end, std::size_t /*thread*/) {
      for (std::size_t c = begin; c < end; ++c) moved[c] = anneal_one(*chains_[c], steps) ? 1 : 0;
    });
    for (const auto& chain : chains_) {
      if (chain->home.cost < best_.cost) best_ = chain->home;
    }
    // Half of them go on from the best of all, the others from their own.
    for (std::size_t c = 0; c < chains_.size(); c += 2) chains_[c]->home = best_;
    return std::any_of(moved.begin(), moved.end(), [](std::uint8_t one) { return one != 0; });
  }

  bool anneal_one(Chain& chain, std::size_t steps) const {
    chain.search.begin(chain.home, nullptr);
    std::size_t moved = 0;
    for (; moved < steps && !out_of_time(); ++moved) {
      chain.search.set_temperature(
          kRound.at(static_cast<double>(moved) / static_cast<double>(steps)));
      if (!chain.search.step(chain.random)) break;
    }
    chain.played += moved;
    if (chain.search.best().cost < chain.home.cost) {
      chain.home = chain.search.best();
    }
    return moved > 0;
  }

  void report(const std::function<void(const SolveProgress&)>& progress) const {
    if (!progress) return;
    double share = 0.0;
    if (options_.budget_ns > 0) {
      share =
          static_cast<double>(context_.now_ns() - begun_) / static_cast<double>(options_.budget_ns);
    }
    if (options_.rollouts > 0) {
      share =
          std::max(share, static_cast<double>(played()) / static_cast<double>(options_.rollouts));
    }
    progress({.finished = best_.cost < kUnfinished,
              .makespan = makespan_of(best_.cost),
              .rollouts = played(),
              .share = std::clamp(share, 0.0, 1.0)});
  }

  [[nodiscard]] Tick makespan_of(Cost cost) const {
    return cost < kUnfinished ? static_cast<Tick>(cost) : start_.horizon;
  }

  [[nodiscard]] Solution solution() const {
    Solution solution{.finished = best_.cost < kUnfinished,
                      .makespan = makespan_of(best_.cost),
                      .warm_start = warm_start_,
                      .warm_makespan = makespan_of(warm_cost_),
                      .rollouts = played()};
    for (std::size_t d = 0; d < best_.decisions.size(); ++d) {
      RecordedDecision& decision = solution.decisions.emplace_back();
      decision.tick = best_.before[d].now + 1;
      decision.task = best_.decisions[d].task;
      decision.members = best_.decisions[d].members;
    }
    return solution;
  }

  const Simulator& simulator_;
  const SolveOptions& options_;
  const PlannerContext& context_;
  std::unique_ptr<WorkerPool> pool_;
  std::vector<std::unique_ptr<Chain>> chains_;
  SimulationState start_;
  std::int64_t begun_ = 0;
  Future best_;
  std::string warm_start_;
  Cost warm_cost_ = kWorst;
  std::size_t warm_played_ = 0;
};

}  // namespace

Solution solve(const Simulator& simulator, const RunSetup& setup, const SolveOptions& options,
               const PlannerContext& context,
               const std::function<void(const SolveProgress&)>& progress) {
  return Solver(simulator, setup, options, context).run(progress);
}

}  // namespace linewright
