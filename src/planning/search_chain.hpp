#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "future.hpp"
#include "linewright/base/random.hpp"
#include "linewright/planning/planner.hpp"
#include "local_search.hpp"
#include "simple_planners.hpp"

namespace linewright::planning {

/// Chains that share a number of futures, where no time but this number limits a search: the result
/// must not depend on the machine's cores.
inline constexpr std::size_t kChainsOfRollouts = 4;

/// Simulated annealing: while a share (0 to 1) of a search passes, the temperature falls from hot
/// to cold, in ticks, by equal factors.
struct Cooling {
  double hot = 0.0;
  double cold = 1.0;

  [[nodiscard]] double at(double share) const {
    return hot * std::pow(cold / hot, std::clamp(share, 0.0, 1.0));
  }
};

/// One search, and what it needs of its own so that it can run beside others.
struct SearchChain {
  struct Options {
    std::string base;  ///< planner that plays on where a future has no wish; empty: the default
    bool free_agents = false;
    bool wait = false;
  };

  SearchChain(const Simulator& simulator, const Options& options, const PlannerContext& context,
              std::function<bool()> give_up)
      : base(base_planner(options.base, simulator, context)),
        player(
            simulator,
            {.allocator = context.allocator, .wait = options.wait, .give_up = std::move(give_up)}),
        search(player, *base, options.free_agents),
        random(0) {}

  std::unique_ptr<Planner> base;
  FuturePlayer player;
  LocalSearch search;
  RandomStream random;
};

}  // namespace linewright::planning
