// Planners that look ahead, rules, tuning and solving, on the lines of the repository.

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "linewright/allocation/allocator.hpp"
#include "linewright/base/diagnostic.hpp"
#include "linewright/base/random.hpp"
#include "linewright/planning/episode.hpp"
#include "linewright/planning/lookahead.hpp"
#include "linewright/planning/rules.hpp"
#include "linewright/planning/solve.hpp"
#include "linewright/planning/tune_priority.hpp"
#include "tests/support.hpp"

namespace linewright::testing {
namespace {

constexpr const char* kDuctLine = "scenarios/duct_line.yaml";
constexpr const char* kBase = "priority:1,2,8,7,3,5,4,9,6";

std::string complaint(const std::string& planner, const PlannerContext& context = {}) {
  try {
    static_cast<void>(PlannerRegistry::make(planner, *shipped_line(kDuctLine).simulator, context));
  } catch (const ScenarioError& error) {
    return error.what();
  }
  return "";
}

Tick makespan(const SimulationState& state) {
  return state.status == RunStatus::kFinished ? state.now : 2 * state.horizon;
}

class EveryRule : public ::testing::TestWithParam<std::string> {};

TEST_P(EveryRule, GivesTheSameLogForTheSameSeed) {
  for (const std::string& file : shipped_scenarios()) {
    const Line& line = shipped_line(file);
    const LoggedRun run = run_line(line, {}, 3, GetParam(), "sap");
    EXPECT_EQ(run.text, run_line(line, {}, 3, GetParam(), "sap").text) << file;
    EXPECT_TRUE(run.state.ended()) << file;
  }
}

std::vector<std::string> rules_and_lookahead() {
  std::vector<std::string> names{"lookahead:8r", "lookahead:8r,agents=free,wait=true"};
  for (const Rule& rule : dispatching_rules()) names.emplace_back(rule.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(All, EveryRule, ::testing::ValuesIn(rules_and_lookahead()),
                         [](const ::testing::TestParamInfo<std::string>& planner) {
                           std::string name = planner.param;
                           for (char& c : name) c = std::isalnum(c) != 0 ? c : '_';
                           return name;
                         });

TEST(Lookahead, IsNeverWorseThanItsBasePlannerFromTheSameStart) {
  const Line& line = shipped_line(kDuctLine);
  for (const std::string base : {"first", "spt", "fifo", kBase}) {
    for (const auto& crew : {std::vector{1, 1}, std::vector{2, 3}}) {
      for (const char* rollouts : {"1r", "7r", "40r"}) {
        const std::string planner = std::string("lookahead:") + rollouts + ",base=" + base;
        const LoggedRun run = run_line(line, crew_of(crew), 5, planner, "sap");
        const LoggedRun plain = run_line(line, crew_of(crew), 5, base, "sap");
        EXPECT_LE(makespan(run.state), makespan(plain.state)) << planner;
      }
    }
  }
}

TEST(Lookahead, WithOneRolloutDecidesAsItsBase) {
  const Line& line = shipped_line(kDuctLine);
  const std::string base(kBase);
  EXPECT_EQ(run_line(line, crew_of({2, 2}), 1, "lookahead:1r,base=" + base, "first_idle").text,
            run_line(line, crew_of({2, 2}), 1, base, "first_idle").text);
}

TEST(Lookahead, GivesTheSameRunForAnyNumberOfThreads) {
  const Line& line = shipped_line(kDuctLine);
  for (const char* options : {"", ",agents=free,wait=true"}) {
    const std::string planner = std::string("lookahead:40r,base=") + kBase + options;
    const std::string one = run_line(line, crew_of({2, 2}), 2, planner + ",threads=1", "sap").text;
    EXPECT_EQ(run_line(line, crew_of({2, 2}), 2, planner + ",threads=2", "sap").text, one);
    EXPECT_EQ(run_line(line, crew_of({2, 2}), 2, planner + ",threads=7", "sap").text, one);
  }
}

TEST(Lookahead, FindsShorterRunsWithFreeAgentsAndWaiting) {
  const Line& line = shipped_line(kDuctLine);
  const std::string planner = std::string("lookahead:80r,base=") + kBase;
  int with_allocator = 0;
  int free = 0;
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    with_allocator += makespan(run_line(line, crew_of({1, 2}), seed, planner, "sap").state);
    free += makespan(
        run_line(line, crew_of({1, 2}), seed, planner + ",agents=free,wait=true", "sap").state);
  }
  EXPECT_LT(free, with_allocator);
}

TEST(Lookahead, PlansUnderAnAllocatorThatDrawsAtRandom) {
  const Line& line = shipped_line(kDuctLine);
  const std::string planner = std::string("lookahead:10r,base=") + kBase;
  int sum = 0;
  int plain = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const LoggedRun run = run_line(line, crew_of({3, 3}), seed, planner, "no_spatial");
    EXPECT_EQ(run.text, run_line(line, crew_of({3, 3}), seed, planner, "no_spatial").text);
    sum += makespan(run.state);
    plain += makespan(run_line(line, crew_of({3, 3}), seed, kBase, "no_spatial").state);
  }
  EXPECT_LT(sum, plain);
}

/// A clock that goes on by itself: each question takes `step`.
PlannerContext context_with_clock(std::int64_t step, const std::string& allocator = "sap") {
  const auto time = std::make_shared<std::int64_t>(0);
  return {.allocator = allocator, .now_ns = [time, step] { return *time += step; }};
}

TEST(Lookahead, DecidesAsItsBaseWhenThereIsNoTimeForOneFuture) {
  const Simulator& simulator = *shipped_line(kDuctLine).simulator;
  const auto planner =
      PlannerRegistry::make("lookahead:1ms,base=first", simulator, context_with_clock(10'000'000));
  const auto first = PlannerRegistry::make("first", simulator);
  const auto allocator = make_allocator("sap", simulator);
  const RunSetup setup = sample_setup(simulator.line(), crew_of({2, 2}), 1);
  SimulationState state;
  EXPECT_EQ(run_episode(simulator, state, setup, 1, *planner, *allocator), RunStatus::kFinished);
  const Tick ours = state.now;
  run_episode(simulator, state, setup, 1, *first, *allocator);
  EXPECT_EQ(ours, state.now);
}

TEST(Lookahead, StaysWithinItsBudgetByTheClockItIsGiven) {
  const Simulator& simulator = *shipped_line(kDuctLine).simulator;
  const PlannerContext context = context_with_clock(1'000);
  const auto planner = PlannerRegistry::make("lookahead:1ms", simulator, context);
  const auto allocator = make_allocator("sap", simulator);
  SimulationState state;
  std::vector<std::int64_t> took;
  run_episode(simulator, state, sample_setup(simulator.line(), crew_of({2, 2}), 1), 1, *planner,
              *allocator, {.now_ns = context.now_ns, .decision_ns = &took});
  ASSERT_FALSE(took.empty());
  for (const std::int64_t ns : took) EXPECT_LT(ns, 1'100'000);
}

TEST(Lookahead, NeedsAClockForABudgetInTime) {
  EXPECT_NE(complaint("lookahead:1ms").find("no clock"), std::string::npos);
  EXPECT_EQ(complaint("lookahead:1ms", context_with_clock(1)), "");
  EXPECT_NE(complaint("lookahead:5r,base=frist").find("did you mean 'first'?"), std::string::npos);
  EXPECT_NE(complaint("lokahead:1ms").find("did you mean 'lookahead'?"), std::string::npos);
  EXPECT_NE(complaint("spt:3").find("takes no"), std::string::npos);
  EXPECT_NE(complaint("most_urgent_bufer").find("'most_urgent_buffer'"), std::string::npos);
}

TEST(TunePriority, IsBetterThanTheOrderOfTheFileAndTheSameForAnyNumberOfThreads) {
  const Simulator& simulator = *shipped_line(kDuctLine).simulator;
  TuneOptions options{.crews = {crew_of({2, 2}), crew_of({3, 3})}, .starts = 3, .most_runs = 2500};
  std::vector<double> seen;
  options.progress = [&](const TunedPriority& best) { seen.push_back(best.makespan); };
  options.threads = 1;
  const TunedPriority one = tune_priority(simulator, options);
  EXPECT_LT(one.makespan, seen.front() * 0.97);
  EXPECT_TRUE(std::is_sorted(seen.rbegin(), seen.rend()));
  EXPECT_EQ(one.success_rate, 1.0);
  EXPECT_EQ(one.order.size(), simulator.line().tasks.size());
  options.threads = 2;
  EXPECT_EQ(tune_priority(simulator, options).order, one.order);
}

TEST(TunePriority, StopsWhenCancelledAndKeepsTheBest) {
  const Simulator& simulator = *shipped_line(kDuctLine).simulator;
  CancelToken cancel;
  TuneOptions options{.crews = {crew_of({2, 2})}, .starts = 2, .cancel = &cancel};
  options.progress = [&](const TunedPriority& best) {
    if (best.runs > 100) cancel.request();
  };
  const TunedPriority tuned = tune_priority(simulator, options);
  EXPECT_EQ(tuned.order.size(), simulator.line().tasks.size());
  EXPECT_LT(tuned.runs, 5000U);
}

TEST(TunePriority, OfAllOrdersIsNoWorseThanTheSearch) {
  const Simulator& simulator = *shipped_line("scenarios/teaching/kitting_cell.yaml").simulator;
  TuneOptions options{.crews = {RunOptions{}}, .starts = 4, .most_runs = 400};
  const TunedPriority searched = tune_priority(simulator, options);
  const TunedPriority all = try_all_orders(simulator, options);
  EXPECT_LE(all.makespan, searched.makespan);
  EXPECT_EQ(all.order.size(), simulator.line().tasks.size());
  EXPECT_EQ(all.success_rate, 1.0);
  options.threads = 1;
  EXPECT_EQ(try_all_orders(simulator, options).order, all.order);
  CancelToken cancel;
  cancel.request();
  options.cancel = &cancel;
  EXPECT_EQ(try_all_orders(simulator, options).order.size(), all.order.size());
}

TEST(Solve, FindsAPlanThatReplaysToItsMakespan) {
  const Simulator& simulator = *shipped_line(kDuctLine).simulator;
  for (const bool free : {false, true}) {
    const RunSetup setup = sample_setup(simulator.line(), crew_of({2, 2}), 7);
    const Solution solution =
        solve(simulator, setup, {.free_agents = free, .wait = free, .rollouts = 3000}, {});
    ASSERT_TRUE(solution.finished);
    EXPECT_LT(solution.makespan, solution.warm_makespan);
    SimulationState state;
    const auto fallback = make_allocator("sap", simulator);
    replay(simulator, state, setup, solution.decisions, *fallback);
    EXPECT_EQ(state.status, RunStatus::kFinished);
    EXPECT_EQ(state.now, solution.makespan);
  }
}

TEST(Solve, GivesTheSamePlanForAnyNumberOfThreads) {
  const Simulator& simulator = *shipped_line(kDuctLine).simulator;
  const RunSetup setup = sample_setup(simulator.line(), crew_of({1, 2}), 7);
  const auto plan = [&](std::size_t threads) {
    std::vector<std::pair<Tick, int>> decisions;
    for (const RecordedDecision& decision :
         solve(simulator, setup, {.rollouts = 1500}, {.threads = threads}).decisions) {
      decisions.emplace_back(decision.tick, decision.task.value);
    }
    return decisions;
  };
  EXPECT_EQ(plan(1), plan(2));
}

TEST(Solve, SaysWhatItCannotWorkWith) {
  const Simulator& simulator = *shipped_line(kDuctLine).simulator;
  const RunSetup setup = sample_setup(simulator.line(), crew_of({3, 3}), 1);
  const auto message = [&](const SolveOptions& options, const PlannerContext& context) {
    try {
      static_cast<void>(solve(simulator, setup, options, context));
    } catch (const ScenarioError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(message({}, {}).find("budget of zero"), std::string::npos);
  EXPECT_NE(message({.budget_ns = 1000}, {}).find("no clock"), std::string::npos);
  EXPECT_NE(message({.rollouts = 10}, {.allocator = "no_spatial"}).find("draws at random"),
            std::string::npos);
  EXPECT_NE(message({.budget_ns = 1}, context_with_clock(10)).find("within the budget"),
            std::string::npos);
}

}  // namespace
}  // namespace linewright::testing
