// What a search has found is what happens when its plan is played again.

#include <gtest/gtest.h>

#include "src/planning/search_chain.hpp"
#include "tests/support.hpp"

namespace linewright::testing {
namespace {

using planning::Cost;
using planning::Future;
using planning::kUnfinished;
using planning::kWorst;
using planning::SearchChain;
using planning::Wish;

/// Plays the decisions from the start; nothing but them decides as long as there are some.
Future played_again(SearchChain& chain, const SimulationState& start, const Future& future) {
  std::vector<Wish> wishes = future.decisions;
  Future again;
  chain.player.play(start, nullptr, wishes, *chain.base, kWorst, again);
  EXPECT_TRUE(wishes.empty());
  return again;
}

class PlansOfASearch : public ::testing::TestWithParam<SearchChain::Options> {};

TEST_P(PlansOfASearch, HappenAgainAsTheyWereFound) {
  const Line& line = shipped_line("scenarios/duct_line.yaml");
  SearchChain chain(*line.simulator, GetParam(), {.allocator = "sap"}, [] { return false; });
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const std::vector<int> crew{1 + static_cast<int>(seed % 3), 1 + static_cast<int>(seed / 3)};
    SimulationState start;
    line.simulator->reset(start, sample_setup(line.scenario.line, crew_of(crew, 4), seed));
    Future first;
    std::vector<Wish> nothing;
    chain.player.play(start, nullptr, nothing, *chain.base, kWorst, first);
    chain.search.begin(first, nullptr);
    chain.search.set_temperature(20.0);
    chain.random = RandomStream::derive(seed, "search");
    Cost known = kWorst;
    for (int steps = 0; steps < 1500; ++steps) {
      ASSERT_TRUE(chain.search.step(chain.random));
      const Future& best = chain.search.best();
      if (best.cost >= known) continue;
      known = best.cost;
      ASSERT_LT(best.cost, kUnfinished);
      const Future again = played_again(chain, start, best);
      ASSERT_EQ(again.cost, best.cost) << "seed " << seed << ", step " << steps;
      ASSERT_EQ(again.decisions.size(), best.decisions.size());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, PlansOfASearch,
                         ::testing::Values(SearchChain::Options{},
                                           SearchChain::Options{.wait = true},
                                           SearchChain::Options{.free_agents = true},
                                           SearchChain::Options{.free_agents = true, .wait = true}),
                         [](const ::testing::TestParamInfo<SearchChain::Options>& options) {
                           return std::string(options.param.free_agents ? "free" : "nearest") +
                                  (options.param.wait ? "_waiting" : "");
                         });

}  // namespace
}  // namespace linewright::testing
