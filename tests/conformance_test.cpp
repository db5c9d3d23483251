// What every scenario, planner and allocator has to keep to, on all scenarios of the repository.

#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "linewright/allocation/allocator.hpp"
#include "linewright/evaluation/event_log_writer.hpp"
#include "linewright/evaluation/recorded_run.hpp"
#include "linewright/planning/episode.hpp"
#include "linewright/planning/planner.hpp"
#include "tests/support.hpp"

namespace linewright::testing {
namespace {

using Json = nlohmann::json;

/// Follows every token through a log, with nothing but the log.
class Audit {
 public:
  explicit Audit(const std::string& text) {
    std::istringstream in(text);
    std::string line;
    std::getline(in, line);
    head_ = Json::parse(line);
    for (const Json& place : head_["places"]) {
      count_[place["name"]] = place["initial"];
      if (place.contains("capacity")) capacity_[place["name"]] = place["capacity"];
      if (place.contains("berth")) berths_.insert(place["name"].get<std::string>());
    }
    for (const Json& carrier : head_["carriers"]) {
      count_[carrier["id"]] = 0;
      capacity_[carrier["id"]] = carrier["capacity"];
    }
    for (const Json& operation : head_["operations"]) operations_[operation["name"]] = operation;
    while (std::getline(in, line)) events_.push_back(Json::parse(line));
    run();
  }

  std::string problem;
  [[nodiscard]] int count(const std::string& place) const { return count_.at(place); }

 private:
  void run() {
    // Items under way by hand are put down at their `until`.
    std::multimap<int, std::pair<std::string, std::string>> in_hand;
    int now = 0;
    for (const Json& event : events_) {
      const int tick = event["t"];
      if (tick < now) problem = "time runs backwards at " + event.dump();
      now = tick;
      while (!in_hand.empty() && in_hand.begin()->first <= now) {
        move(in_hand.begin()->second.first, -1, event);
        move(in_hand.begin()->second.second, +1, event);
        in_hand.erase(in_hand.begin());
      }
      const std::string what = event["event"];
      if (what == "transfer") {
        in_hand.emplace(event["until"].get<int>(), std::pair{event["from"], event["to"]});
      } else if (what == "operation_start") {
        machines(event, true);
        for (const auto& [place, n] : flows(event, "consumes")) move(place, -n, event);
      } else if (what == "operation_end") {
        for (const auto& [place, n] : flows(event, "produces")) move(place, n, event);
        const Json& operation = operations_[event["operation"]];
        if (!operation.contains("recovery")) machines(event, false);
      } else if (what == "recovery_end") {
        machines(event, false);
      } else if (what == "put_down" && event.contains("berth")) {
        standing_[event["berth"]] = event["carrier"];
      } else if (what == "berth") {
        standing_[event["berth"]] = event["carrier"];
      } else if (what == "decision") {
        crew(event, true);
      } else if (what == "task_end" || what == "release" || what == "join") {
        crew(event, what == "join");
      }
    }
  }

  std::map<std::string, int> flows(const Json& event, const char* key) {
    const Json& operation = operations_[event["operation"]];
    return operation.contains(key) ? operation[key].get<std::map<std::string, int>>()
                                   : std::map<std::string, int>{};
  }

  void move(std::string where, int n, const Json& event) {
    if (berths_.contains(where)) {
      if (!standing_.contains(where)) {
        problem = "nothing stands in " + where + " at " + event.dump();
        return;
      }
      where = standing_[where];
    }
    int& count = count_[where];
    count += n;
    if (count < 0) problem = where + " has " + std::to_string(count) + " at " + event.dump();
    if (capacity_.contains(where) && count > capacity_[where]) {
      problem = where + " holds too much at " + event.dump();
    }
  }

  void machines(const Json& event, bool take) {
    const Json& operation = operations_[event["operation"]];
    const auto each = [&](const char* key, auto&& what) {
      if (!operation.contains(key)) return;
      for (const Json& machine : operation[key]) what(machine.get<std::string>());
    };
    const auto take_it = [&](const std::string& machine) {
      if (!taken_.insert(machine).second) problem = machine + " taken twice at " + event.dump();
    };
    const auto let_go = [&](const std::string& machine) {
      if (taken_.erase(machine) == 0) problem = machine + " was not taken at " + event.dump();
    };
    if (take) {
      each("uses", take_it);
      each("claims", take_it);
    } else {
      each("uses", let_go);
      each("frees", let_go);
    }
  }

  void crew(const Json& event, bool bind) {
    if (event["event"] == "decision") {
      for (const auto& [role, members] : event["crew"].items()) {
        for (const Json& member : members) {
          bound_to_[event["n"]].push_back(member);
          const std::string id = member;
          for (auto berth = standing_.begin(); berth != standing_.end();) {
            berth = berth->second == id ? standing_.erase(berth) : std::next(berth);
          }
          if (!busy_.insert(id).second) problem = id + " is busy already at " + event.dump();
        }
      }
    } else if (event["event"] == "join") {
      if (bind && !busy_.insert(event["worker"]).second)
        problem = "joiner is busy at " + event.dump();
      bound_to_[event["n"]].push_back(event["worker"]);
    } else if (event["event"] == "release") {
      busy_.erase(event["worker"]);
      std::erase(bound_to_[event["n"]], event["worker"].get<std::string>());
    } else {
      for (const std::string& member : bound_to_[event["n"]]) busy_.erase(member);
    }
  }

  Json head_;
  std::vector<Json> events_;
  std::map<std::string, int> count_;
  std::map<std::string, int> capacity_;
  std::set<std::string> berths_;
  std::map<std::string, std::string> standing_;  // berth -> carrier
  std::map<std::string, Json> operations_;
  std::set<std::string> taken_;
  std::set<std::string> busy_;
  std::map<int, std::vector<std::string>> bound_to_;
};

class EveryLine : public ::testing::TestWithParam<std::string> {};

TEST_P(EveryLine, ConservesTokensMachinesAndPeople) {
  const Line& line = shipped_line(GetParam());
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const LoggedRun run =
        run_line(line, {}, seed, seed % 2 == 0 ? "random" : "first", "no_spatial");
    const Audit audit(run.text);
    ASSERT_EQ(audit.problem, "") << "seed " << seed;
    const Order& order = line.scenario.line.order;
    const Variable finished{VariableKind::kPlaceCount, order.finished_in.value};
    EXPECT_EQ(audit.count(line.scenario.line.places[order.finished_in.index()].name),
              line.simulator->value(run.state, finished));
  }
}

TEST_P(EveryLine, ReplaysItsOwnLogs) {
  const Line& line = shipped_line(GetParam());
  const auto fallback = make_allocator("first_idle", *line.simulator);
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const LoggedRun run = run_line(line, {}, seed, "random", "no_spatial");
    const RecordedRun recorded = read_recorded_run(run.text, "log", line.simulator->line());
    LoggedRun again;
    replay(*line.simulator, again.state, recorded.setup, recorded.decisions, *fallback, &again.log);
    EXPECT_EQ(event_log_text(line.scenario, again.log, line.simulator->progress(again.state)),
              run.text)
        << "seed " << seed;
  }
}

std::vector<std::string> all_lines() {
  std::vector<std::string> files = shipped_scenarios();
  for (const std::string& file : awkward_scenarios()) files.push_back(file);
  return files;
}

INSTANTIATE_TEST_SUITE_P(All, EveryLine, ::testing::ValuesIn(all_lines()),
                         [](const ::testing::TestParamInfo<std::string>& scenario) {
                           return std::filesystem::path(scenario.param).stem().string();
                         });

TEST(WaitingAction, StartsInTheTickInWhichAnOperationMakesRoom) {
  const Line& line = shipped_line("tests/data/awkward/waiting_for_room.yaml");
  const LoggedRun run = run_line(line, {}, 1, "first", "sap");
  EXPECT_NE(run.text.find("{\"t\":2,\"event\":\"transfer\""), std::string::npos) << run.text;
}

TEST(Milestone, OfABerthIsNotedWhenAWorkerPutsTheItemIn) {
  const Line& line = shipped_line("tests/data/awkward/milestone_of_a_berth.yaml");
  EXPECT_NE(run_line(line, {}, 1, "first", "sap").text.find("in_bay"), std::string::npos);
}

class EveryScenario : public ::testing::TestWithParam<std::string> {};

TEST_P(EveryScenario, GivesTheSameLogForTheSameSeedAndAnotherForAnother) {
  const Line& line = shipped_line(GetParam());
  std::set<std::string> logs;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const LoggedRun run = run_line(line, {}, seed, "random", "no_spatial");
    EXPECT_EQ(run.text, run_line(line, {}, seed, "random", "no_spatial").text);
    logs.insert(run.text);
  }
  EXPECT_GT(logs.size(), 1U);
}

TEST_P(EveryScenario, MakesOnlySelectableTasksAssignable) {
  const Line& line = shipped_line(GetParam());
  const Simulator& simulator = *line.simulator;
  for (const std::string& name : allocator_names()) {
    const auto allocator = make_allocator(name, simulator);
    const auto planner = PlannerRegistry::make("random", simulator);
    SimulationState state;
    simulator.reset(state, sample_setup(simulator.line(), {}, 3));
    planner->reset(3);
    allocator->reset(3);
    while (advance_and_join(simulator, state, *allocator) == RunStatus::kDecision) {
      for (std::size_t t = 0; t < simulator.line().tasks.size(); ++t) {
        const TaskId task(t);
        EXPECT_EQ(state.is_selectable(task), simulator.explain_unselectable(state, task).empty());
        const Assignment assignment =
            state.is_selectable(task) ? allocator->allocate(state, task) : Assignment(task);
        EXPECT_EQ(simulator.explain_refusal(state, assignment).empty(), state.is_selectable(task));
      }
      const auto task = planner->choose_task(state);
      ASSERT_TRUE(task);
      ASSERT_TRUE(simulator.assign(state, allocator->allocate(state, *task)));
    }
    EXPECT_TRUE(state.ended());
  }
}

TEST_P(EveryScenario, IsFinishedByTheFirstTaskRule) {
  const Line& line = shipped_line(GetParam());
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    EXPECT_EQ(run_line(line, {}, seed, "first", "sap").state.status, RunStatus::kFinished) << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(All, EveryScenario, ::testing::ValuesIn(shipped_scenarios()),
                         [](const ::testing::TestParamInfo<std::string>& scenario) {
                           std::string name = std::filesystem::path(scenario.param).stem().string();
                           return name;
                         });

TEST(Allocators, AgreeWhenThereIsNothingToChoose) {
  const Line& line = shipped_line("scenarios/duct_line.yaml");
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const std::string sap = run_line(line, crew_of({1, 1}), seed, "first", "sap").text;
    for (const std::string& other : allocator_names()) {
      EXPECT_EQ(run_line(line, crew_of({1, 1}), seed, "first", other).text, sap) << other;
    }
  }
}

TEST(Allocators, DifferWhenThereIs) {
  const Line& line = shipped_line("scenarios/duct_line.yaml");
  std::set<std::string> logs;
  for (const char* name : {"sap", "no_spatial", "longest_path", "first_idle"}) {
    logs.insert(run_line(line, crew_of({3, 3}), 1, "first", name).text);
  }
  EXPECT_EQ(logs.size(), 4U);
}

TEST(Allocators, SnappedIsSapWhileFreeWorkersStand) {
  const Line& line = shipped_line("scenarios/duct_line.yaml");
  EXPECT_EQ(run_line(line, crew_of({3, 3}), 1, "random", "sap_snapped").text,
            run_line(line, crew_of({3, 3}), 1, "random", "sap").text);
}

}  // namespace
}  // namespace linewright::testing
