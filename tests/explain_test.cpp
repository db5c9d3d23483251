#include "linewright/planning/explain.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "linewright/allocation/allocator.hpp"
#include "linewright/evaluation/event_log_writer.hpp"
#include "linewright/evaluation/explanation_text.hpp"
#include "linewright/evaluation/log_document.hpp"
#include "linewright/planning/shield.hpp"
#include "tests/support.hpp"

namespace linewright {
namespace {

/// A run of the duct line with every decision explained as it was taken.
struct Explained {
  explicit Explained(const std::string& planner, std::vector<int> crew, bool shielded = false)
      : line(testing::shipped_line("scenarios/duct_line.yaml")), simulator(*line.simulator) {
    const auto who_plans = PlannerRegistry::make(planner, simulator, {.allocator = "sap"});
    const auto who_allocates = make_allocator("sap", simulator);
    const auto base = PlannerRegistry::make("first", simulator);
    const auto base_allocator = make_allocator("sap", simulator);
    Shield shield(simulator);
    EpisodeOptions options{.log = &log, .shield = shielded ? &shield : nullptr};
    options.observe = [&](const SimulationState& now, const GuardedDecision& decision) {
      decisions.push_back(explain_decision(simulator, now, decision, *base, *base_allocator));
      states.push_back(now);
    };
    const RunSetup setup = sample_setup(simulator.line(), testing::crew_of(std::move(crew), 3), 7);
    run_episode(simulator, state, setup, 7, *who_plans, *who_allocates, options);
  }

  const testing::Line& line;
  const Simulator& simulator;
  SimulationState state;
  EventLog log;
  std::vector<DecisionExplanation> decisions;
  std::vector<SimulationState> states;
};

TEST(Explain, EstimatesWhatTheBaseRuleReallyReaches) {
  const Explained run("first", {2, 2});
  ASSERT_EQ(run.state.status, RunStatus::kFinished);
  ASSERT_GT(run.decisions.size(), 10U);
  for (const DecisionExplanation& decision : run.decisions) {
    const auto chosen =
        std::find_if(decision.alternatives.begin(), decision.alternatives.end(),
                     [&](const auto& a) { return a.task == decision.assignment->task; });
    ASSERT_NE(chosen, decision.alternatives.end());
    EXPECT_EQ(chosen->estimate, run.state.now);
  }
}

TEST(Explain, NamesEveryTaskOnceAndWhoCouldDoIt) {
  const Explained run("random", {3, 2}, true);
  for (std::size_t i = 0; i < run.decisions.size(); ++i) {
    const DecisionExplanation& decision = run.decisions[i];
    const SimulationState& state = run.states[i];
    EXPECT_EQ(decision.alternatives.size() + decision.unselectable.size(),
              run.simulator.line().tasks.size());
    for (const auto& a : decision.alternatives) EXPECT_TRUE(state.is_selectable(a.task));
    for (const auto& u : decision.unselectable) {
      EXPECT_FALSE(state.is_selectable(u.task));
      EXPECT_FALSE(u.reason.empty());
    }
    for (const auto& member : decision.members) {
      std::size_t chosen = 0;
      for (const auto& candidate : member.candidates) {
        EXPECT_TRUE(state.workers[candidate.worker.index()].free());
        chosen += candidate.chosen ? 1 : 0;
      }
      EXPECT_LE(chosen, 1U);
    }
  }
}

TEST(Explain, SaysWhatTheShieldRulesOut) {
  std::size_t ruled_out = 0;
  const Explained run("random", {1, 1}, true);
  for (const DecisionExplanation& decision : run.decisions) {
    for (const auto& alternative : decision.alternatives) {
      if (!alternative.ruled_out) continue;
      ++ruled_out;
      EXPECT_FALSE(decision.assignment && decision.assignment->task == alternative.task);
      EXPECT_FALSE(alternative.estimate);
    }
  }
  EXPECT_GT(ruled_out, 0U);
  EXPECT_EQ(run.state.status, RunStatus::kFinished);
}

TEST(Explain, SaysWhenTheRunEndsAsPlannedAndNoPlanIsEverWorseThanTheOneBefore) {
  for (const std::vector<int>& crew : {std::vector{1, 3}, std::vector{2, 2}, std::vector{3, 2}}) {
    const Explained run("lookahead:150r,agents=free,wait=true", crew);
    ASSERT_EQ(run.state.status, RunStatus::kFinished);
    Tick before = kMaxTicks;
    for (const DecisionExplanation& decision : run.decisions) {
      ASSERT_TRUE(decision.planned_end);
      EXPECT_LE(*decision.planned_end, before) << decision.tick;
      before = *decision.planned_end;
    }
    EXPECT_EQ(before, run.state.now);
    const std::string text =
        explanation_text(run.simulator.line(), run.log.setup, run.decisions[0]);
    EXPECT_NE(text.find("as planned the run ends at "), std::string::npos) << text;
    const std::string log = event_log_text(run.line.scenario, run.log, 1.0, run.decisions);
    EXPECT_NE(log.find("\"planned_end\":" + std::to_string(before)), std::string::npos);
  }
  EXPECT_FALSE(Explained("first", {2, 2}).decisions.at(0).planned_end);
}

TEST(Explain, StandsInTheLogAndLeavesTheRestAsItWas) {
  const Explained run("first", {2, 1});
  const std::string plain = event_log_text(run.line.scenario, run.log, 1.0);
  const std::string text = event_log_text(run.line.scenario, run.log, 1.0, run.decisions);
  std::istringstream lines(text);
  std::string without;
  std::size_t decision = 0;
  for (std::string row; std::getline(lines, row);) {
    auto object = nlohmann::ordered_json::parse(row);
    if (object.value("event", "") == "decision") {
      const auto& why = object.at("why");
      const DecisionExplanation& explanation = run.decisions[decision++];
      EXPECT_EQ(why.at("alternatives").size(), explanation.alternatives.size());
      EXPECT_EQ(why.at("not_selectable").size(), explanation.unselectable.size());
      EXPECT_EQ(why.at("candidates").size(), explanation.members.size());
      object.erase("why");
    }
    without += object.dump() + "\n";
  }
  EXPECT_EQ(decision, run.decisions.size());
  EXPECT_EQ(without, plain);
  std::istringstream again(text);
  EXPECT_EQ(read_event_log(again, "run.jsonl").decisions.size(), decision);
}

TEST(Explain, TextNamesTheDecisionAndItsAlternatives) {
  const Explained run("first", {1, 2});
  const std::string text =
      explanation_text(run.simulator.line(), run.log.setup, run.decisions.at(0));
  EXPECT_EQ(text.substr(0, text.find('\n')), "tick 1: bring_flanges by human.0, robot.0, cage.0");
  EXPECT_NE(text.find("    * bring_flanges: the run would end at about "), std::string::npos)
      << text;
  EXPECT_NE(text.find("      cut_straight: straight_at_cutter is 0, needs 1\n"), std::string::npos)
      << text;
}

}  // namespace
}  // namespace linewright
