#include "linewright/simulation/simulator.hpp"

#include <gtest/gtest.h>

#include "linewright/base/diagnostic.hpp"

namespace linewright {
namespace {

Condition more_than(VariableKind kind, std::int32_t index, std::int32_t bound) {
  return {.any_of = {{Comparison{
              .terms = {{{kind, index}, 1}}, .constant = -bound, .relation = Relation::kGreater}}},
          .text = "test"};
}

/// A bench with two stations 6 ticks apart: parts are carried from a shelf (station 0) to a press
/// (station 1), which turns each into a product in 10 ticks and homes for 4 ticks afterwards.
LineModel press_line() {
  LineModel line;
  line.name = "press";
  line.worker_kinds = {{.name = "human", .count = {1, 2}, .min_leg_ticks = 1}};
  for (const double x : {0.0, 6.0}) {
    line.stations.push_back(
        {.name = x == 0.0 ? "shelf" : "press", .poses = {Pose2{x, 0.0, 0.0}}, .slots = {1}});
  }
  line.travel.emplace_back(2);
  line.travel[0].set(StationId(0), StationId(1), {6, 6.0});
  line.travel[0].set(StationId(1), StationId(0), {6, 6.0});
  line.places = {{.name = "stock", .of = "part", .initial = {0, 1}},
                 {.name = "tray", .of = "part", .capacity = 1},
                 {.name = "done", .of = "product"}};
  Machine press{.name = "press", .positions = {"home", "out"}, .travel = {{0, 8}, {4, 0}}};
  press.homing = Homing{.home = 0, .takes = {0, 4}, .holds = 2};
  line.machines = {press};
  line.operations = {{.name = "stamp",
                      .takes = 10,
                      .uses = {{.machine = MachineId(0), .from = 0, .to = 1}},
                      .consumes = {{PlaceId(1), 1}},
                      .produces = {{PlaceId(2), 1}},
                      .recovery = 3}};
  Task feed{.name = "feed", .number = 1, .crew = {{.role = "human", .worker = WorkerKindId(0)}}};
  feed.when = more_than(VariableKind::kPlaceAvailable, 0, 0);
  feed.reserves = {{PlaceId(0), false}, {PlaceId(1), true}};
  feed.steps = {{{{.slot = 0,
                   .actions = {{.what = GoAction{StationId(1)}},
                               {.what = TransferAction{.source = {PlaceId(0)},
                                                       .destination = {PlaceId(1)},
                                                       .takes = 3},
                                .before = 1,
                                .after = 2}}}}}};
  line.tasks = {feed};
  line.order = {.product = "product", .quantity = 2, .finished_in = PlaceId(2)};
  line.order.done_when = {.any_of = {{Comparison{.terms = {{{VariableKind::kPlaceCount, 2}, 1},
                                                           {{VariableKind::kOrder, 0}, -1}},
                                                 .constant = 0,
                                                 .relation = Relation::kGreaterEqual}}},
                          .text = "done >= order"};
  line.horizon = {{{1'000, 500}}};
  return line;
}

struct Bench {
  explicit Bench(LineModel line = press_line(), int humans = 1)
      : simulator(std::make_shared<const LineModel>(std::move(line))) {
    setup.worker_start = {{}};
    for (int i = 0; i < humans; ++i) setup.worker_start[0].emplace_back(std::int32_t{i});
    setup.order = 2;
    setup.horizon = 500;
    simulator.reset(state, setup, &log);
  }
  bool feed(int worker = 0) {
    Assignment assignment{TaskId(0)};
    assignment.members[0] = static_cast<std::int16_t>(worker);
    return simulator.assign(state, assignment, &log);
  }
  std::vector<Tick> ticks(LogEvent::Type type) const {
    std::vector<Tick> found;
    for (const LogEvent& event : log.events) {
      if (event.type == type) found.push_back(event.tick);
    }
    return found;
  }
  [[nodiscard]] std::int32_t place(VariableKind kind, int id) const {
    return simulator.value(state, {kind, id});
  }

  Simulator simulator;
  RunSetup setup;
  SimulationState state;
  EventLog log;
};

TEST(Simulator, ActsAtTheTickOfTheDecisionAndAddsUpDurations) {
  Bench bench;
  ASSERT_EQ(bench.simulator.advance(bench.state), RunStatus::kDecision);
  EXPECT_EQ(bench.state.now, 0);
  ASSERT_TRUE(bench.feed());
  EXPECT_EQ(bench.state.now, 1);
  // walk 6 from tick 1: 7; 1 before: 8; the item: 11; 2 after: 13.
  bench.simulator.advance_to(bench.state, 12);
  EXPECT_TRUE(bench.ticks(LogEvent::Type::kTaskEnd).empty());
  bench.simulator.advance_to(bench.state, 13, &bench.log);
  EXPECT_EQ(bench.ticks(LogEvent::Type::kTaskEnd), std::vector<Tick>{13});
}

TEST(Simulator, CountsAnItemAtItsSourceUntilItIsPutDown) {
  Bench bench;
  bench.simulator.advance(bench.state);
  bench.feed();
  EXPECT_EQ(bench.place(VariableKind::kPlaceCount, 0), 2);
  EXPECT_EQ(bench.place(VariableKind::kPlaceAvailable, 0), 1);  // reserved by the decision
  EXPECT_EQ(bench.place(VariableKind::kPlaceRoom, 1), 0);
  bench.simulator.advance_to(bench.state, 10);
  EXPECT_EQ(bench.place(VariableKind::kPlaceCount, 0), 2);
  bench.simulator.advance_to(bench.state, 11);
  EXPECT_EQ(bench.place(VariableKind::kPlaceCount, 0), 1);
  EXPECT_EQ(bench.place(VariableKind::kPlaceCount, 1),
            0);  // stamping has taken it in the same tick
  EXPECT_EQ(bench.place(VariableKind::kMachineWorking, 0), 1);
}

TEST(Simulator, KeepsAMachineThroughItsRecoveryAndInterpolatesItsHoming) {
  Bench bench;
  bench.simulator.advance(bench.state);
  bench.feed();
  bench.simulator.advance_to(bench.state, 21, &bench.log);
  EXPECT_EQ(bench.place(VariableKind::kPlaceCount, 2), 1);  // 11 + 10
  EXPECT_EQ(bench.place(VariableKind::kMachineWorking, 0), 0);
  EXPECT_EQ(bench.place(VariableKind::kMachineFree, 0), 0);
  bench.simulator.advance_to(bench.state, 24);
  EXPECT_EQ(bench.place(VariableKind::kMachineFree, 0), 1);
  // The second stamping starts at 24 + ...: the human stands at the press, so the walk is 1 tick.
  bench.feed();  // tick 25: walk 1: 26, before: 27, item: 30; the press is home by then (r = 0): 0
                 // + 10
  bench.simulator.advance(bench.state, &bench.log);
  EXPECT_EQ(bench.state.status, RunStatus::kFinished);
  EXPECT_EQ(bench.state.now, 40);
}

TEST(Simulator, AddsTheTravelOfAMachineThatIsStillOnItsWayHome) {
  LineModel line = press_line();
  line.operations[0].recovery = 0;
  line.tasks[0].steps[0].sequences[0].actions[1].after = 0;
  line.tasks[0].max_running = 2;
  line.places[1].capacity = 2;
  Bench bench(line, 2);
  bench.simulator.advance(bench.state);
  ASSERT_TRUE(bench.feed(0));  // from the shelf: part in the tray at 1 + 6 + 1 + 3 = 11
  ASSERT_TRUE(bench.feed(1));  // from the press: 2 + 1 + 1 + 3 = 7, stamped 7 .. 17
  bench.simulator.advance(bench.state, &bench.log);
  EXPECT_EQ(bench.ticks(LogEvent::Type::kOperationStart), (std::vector<Tick>{7, 17}));
  // At 17 the press has just come to rest at 'out': all 8 ticks of travel, then 10.
  EXPECT_EQ(bench.state.now, 17 + 8 + 10);
}

TEST(Simulator, StopsAtTheHorizonAndAtADeadlock) {
  Bench bench;
  bench.simulator.advance(bench.state);
  EXPECT_EQ(bench.simulator.advance_to(bench.state, 501), RunStatus::kHorizon);
  EXPECT_EQ(bench.state.now, 500);

  LineModel starving = press_line();
  starving.places[0].initial = {1, 0};
  Bench stuck(starving);
  stuck.simulator.advance(stuck.state);
  stuck.feed();
  EXPECT_EQ(stuck.simulator.advance(stuck.state), RunStatus::kDeadlock);
  EXPECT_NE(stuck.simulator.explain_unselectable(stuck.state, TaskId(0)), "");
}

TEST(Simulator, RefusesWhatIsNotPossibleAndSaysWhy) {
  Bench bench(press_line(), 2);
  bench.simulator.advance(bench.state);
  EXPECT_FALSE(bench.feed(5));
  EXPECT_EQ(bench.state.decisions, 0);
  ASSERT_TRUE(bench.feed(1));
  Assignment again{TaskId(0)};
  again.members[0] = 0;
  EXPECT_NE(bench.simulator.explain_refusal(bench.state, again).find("feed.running"),
            std::string::npos);
  Assignment unknown{TaskId(9)};
  EXPECT_NE(bench.simulator.explain_refusal(bench.state, unknown), "");
}

TEST(Simulator, InterpolatesThePositionOfAWorkerUnderWay) {
  Bench bench;
  bench.simulator.advance(bench.state);
  bench.feed();
  EXPECT_DOUBLE_EQ(bench.simulator.worker_pose(bench.state, WorkerId(0), 1).x_m, 0.0);
  EXPECT_DOUBLE_EQ(bench.simulator.worker_pose(bench.state, WorkerId(0), 4).x_m, 3.0);
  EXPECT_DOUBLE_EQ(bench.simulator.worker_pose(bench.state, WorkerId(0), 7).x_m, 6.0);
  bench.simulator.advance_to(bench.state, 3);
  const Leg back = bench.simulator.route_from_worker(bench.state, WorkerId(0), StationId(0));
  EXPECT_EQ(back.ticks, 4 + 6);  // the rest of the way first
}

TEST(Simulator, AContinuedCopyIsTheOriginal) {
  Bench bench;
  bench.simulator.advance(bench.state);
  bench.feed();
  SimulationState copy = bench.state;
  bench.simulator.advance(bench.state);
  bench.feed();
  bench.simulator.advance(bench.state);
  bench.simulator.advance(copy);
  Assignment assignment{TaskId(0)};
  assignment.members[0] = 0;
  bench.simulator.assign(copy, assignment);
  bench.simulator.advance(copy);
  EXPECT_EQ(copy.now, bench.state.now);
  EXPECT_EQ(copy.values, bench.state.values);
}

TEST(LateJoiner, IsBoundAsSoonAsOneIsFree) {
  LineModel line = press_line();
  // A second task that starts alone and needs a human only in its second step.
  Task help{.name = "help",
            .number = 2,
            .crew = {{.role = "human", .worker = WorkerKindId(0), .join_late = true}}};
  help.steps = {{{{.slot = 0, .actions = {{.what = GoAction{StationId(0)}}}}}}};
  line.tasks.push_back(help);
  Bench bench(line);
  bench.simulator.advance(bench.state);
  ASSERT_TRUE(bench.feed());  // the only human is busy until 13
  ASSERT_TRUE(bench.simulator.assign(bench.state, Assignment(TaskId(1)), &bench.log));
  EXPECT_FALSE(bench.simulator.pending_join(bench.state));
  EXPECT_EQ(bench.simulator.advance(bench.state, &bench.log), RunStatus::kJoin);
  EXPECT_EQ(bench.state.now, 13);
  const auto pending = bench.simulator.pending_join(bench.state);
  ASSERT_TRUE(pending);
  ASSERT_TRUE(bench.simulator.join(bench.state, *pending, WorkerId(0), &bench.log));
  EXPECT_EQ(bench.ticks(LogEvent::Type::kJoin), std::vector<Tick>{14});
  bench.simulator.advance_to(bench.state, 20, &bench.log);
  EXPECT_EQ(bench.ticks(LogEvent::Type::kTaskEnd).back(), 20);  // 14 + 6
}

TEST(RunSetup, DrawsWithoutReplacementAndTheSameForTheSameSeed) {
  const LineModel line = press_line();
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const RunSetup setup = sample_setup(line, {.workers = {2}}, seed);
    ASSERT_EQ(setup.worker_start[0].size(), 2U);
    EXPECT_NE(setup.worker_start[0][0], setup.worker_start[0][1]);
    EXPECT_EQ(setup.worker_start, sample_setup(line, {.workers = {2}}, seed).worker_start);
  }
}

TEST(RunSetup, RefusesCrewsAndOrdersThatTheLineCannotHave) {
  const LineModel line = press_line();
  EXPECT_THROW(static_cast<void>(sample_setup(line, {.workers = {3}}, 1)), ScenarioError);
  EXPECT_THROW(static_cast<void>(sample_setup(line, {.workers = {0}}, 1)), ScenarioError);
  EXPECT_THROW(static_cast<void>(sample_setup(line, {.order = 0}, 1)), ScenarioError);
  EXPECT_THROW(static_cast<void>(sample_setup(line, {.horizon = 0}, 1)), ScenarioError);
}

}  // namespace
}  // namespace linewright
