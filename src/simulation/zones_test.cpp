#include <gtest/gtest.h>

#include "hall_line.hpp"
#include "linewright/base/diagnostic.hpp"

namespace linewright {
namespace {

using test::Hall;
using test::kEast;
using test::kMiddle;
using test::kWall;
using test::kWest;
using Type = LogEvent::Type;

constexpr int kGoEast = 0;
constexpr int kGoWest = 1;

/// Walks east from tick 1 with these closures, to the end of tick 60.
Hall walked_east(std::vector<Closure> closures) {
  Hall hall(std::move(closures));
  EXPECT_TRUE(hall.send(kGoEast));
  hall.run_to(60);
  return hall;
}

TEST(Zones, OneThatClosesAheadOfAWorkerReroutesItFromWhereItIs) {
  const Hall hall = walked_east({{kMiddle, 3, 200}});
  ASSERT_EQ(hall.ticks(Type::kZone), std::vector<Tick>{3});
  const auto reroutes = hall.events(Type::kReroute);
  ASSERT_EQ(reroutes.size(), 1U);
  EXPECT_EQ(reroutes[0].tick, 3);
  EXPECT_EQ(reroutes[0].course.origin.x_m, 2.0);
  EXPECT_EQ(reroutes[0].e, 3);
  EXPECT_EQ(reroutes[0].until, 3 + 11);  // 7 m on and 2 m aside, both ways
  EXPECT_EQ(hall.ticks(Type::kTaskEnd), std::vector<Tick>{14});
}

TEST(Zones, TotalsAreWhatWasReallyWalked) {
  const Hall hall = walked_east({{kMiddle, 3, 200}});
  EXPECT_EQ(hall.worker().travel_ticks, 2 + 11);
  EXPECT_EQ(hall.worker().travel_mm, 13'000);
  EXPECT_EQ(hall.worker().rest_ticks, 0);
}

TEST(Zones, ItIsOnTheDetourAfterwards) {
  Hall hall({{kMiddle, 3, 200}});
  hall.send(kGoEast);
  hall.run_to(8);
  EXPECT_EQ(hall.pose(3).x_m, 2.0);
  for (Tick tick = 3; tick <= 14; ++tick) {
    const Pose2 pose = hall.pose(tick);
    EXPECT_FALSE(hall.simulator.line().ways->inside(WorkerKindId(0), pose, kMiddle)) << tick;
  }
  EXPECT_EQ(hall.pose(14).x_m, 9.0);
}

TEST(Zones, OneThatClosesBehindAWorkerOrAroundItChangesNothing) {
  for (const Tick tick : {6, 7, 9, 10, 40}) {  // at x = 5, 6 (inside), 8, 9 and when it is there
    const Hall hall = walked_east({{kMiddle, tick, 200}});
    EXPECT_TRUE(hall.events(Type::kReroute).empty()) << tick;
    EXPECT_EQ(hall.ticks(Type::kTaskEnd), std::vector<Tick>{10}) << tick;
    EXPECT_EQ(hall.worker().travel_mm, 9'000);
  }
}

TEST(Zones, OneThatClosesInTheTickOfTheDecisionIsKnownToTheWay) {
  const Hall hall = walked_east({{kMiddle, 1, 200}});
  ASSERT_EQ(hall.log.events.front().type, Type::kZone);
  ASSERT_EQ(hall.events(Type::kGo).size(), 1U);
  EXPECT_EQ(hall.events(Type::kGo)[0].until, 1 + 13);
  EXPECT_TRUE(hall.events(Type::kReroute).empty());
}

TEST(Zones, WithoutAWayItStopsAndGoesOnWhenThereIsOneAgain) {
  Hall hall({{kWall, 3, 20}});
  hall.send(kGoEast);
  hall.run_to(15);
  EXPECT_EQ(hall.worker().phase, WorkerState::Phase::kNoWay);
  EXPECT_EQ(hall.pose(15).x_m, 2.0);
  EXPECT_EQ(hall.worker().travel_mm, 2'000);
  EXPECT_EQ(hall.simulator.advance(hall.state, &hall.log), RunStatus::kDecision);
  EXPECT_EQ(hall.state.now, 20 + 7);
  EXPECT_EQ(hall.ticks(Type::kBlocked), std::vector<Tick>{3});
  EXPECT_EQ(hall.ticks(Type::kReroute), std::vector<Tick>{20});
  EXPECT_EQ(hall.worker().travel_ticks, 9);
  EXPECT_EQ(hall.worker().travel_mm, 9'000);
  EXPECT_EQ(hall.worker().phase, WorkerState::Phase::kNone);
}

TEST(Zones, AGoThatBeginsWithoutAWayWaitsWhereItStands) {
  Hall hall({{kWall, 1, 20}});
  hall.send(kGoEast);
  EXPECT_EQ(hall.worker().phase, WorkerState::Phase::kNoWay);
  hall.run_to(60);
  EXPECT_EQ(hall.ticks(Type::kBlocked), std::vector<Tick>{1});
  ASSERT_EQ(hall.events(Type::kGo).size(), 1U);
  EXPECT_EQ(hall.events(Type::kGo)[0].e, 20);
  EXPECT_EQ(hall.ticks(Type::kTaskEnd), std::vector<Tick>{29});
}

TEST(Zones, PreparationIsOverWhenTheWayOpensLate) {
  LineModel line = test::hall_line();
  line.tasks[0].steps[0].sequences[0].actions[0].before = 5;
  for (const auto& [open, departs] : {std::pair<Tick, Tick>{3, 6}, {20, 20}}) {
    Hall hall({{kWall, 1, open}}, line);
    hall.send(kGoEast);
    hall.run_to(60);
    EXPECT_EQ(hall.events(Type::kGo).at(0).e, departs);
  }
}

TEST(Zones, OneThatClosesDuringThePreparationChangesTheWayFromTheStation) {
  LineModel line = test::hall_line();
  line.tasks[0].steps[0].sequences[0].actions[0].before = 5;
  Hall hall({{kMiddle, 3, 100}}, line);
  hall.send(kGoEast);
  hall.run_to(60);
  const auto goes = hall.events(Type::kGo);
  ASSERT_EQ(goes.size(), 2U);
  EXPECT_EQ(goes[1].c, kWest.value);
  EXPECT_EQ(goes[1].e, 6);
  EXPECT_EQ(goes[1].until, 6 + 13);
  EXPECT_EQ(hall.worker().travel_mm, 13'000);
  EXPECT_EQ(hall.worker().travel_ticks, 13);
}

TEST(Zones, ATargetWithinAClosedZoneHasNoWay) {
  LineModel line = test::hall_line();
  line.zones.push_back(test::rectangle_zone("east_end", 8, 9, 0, 4));
  test::walk_on_cells(line, 10, 5);
  Hall hall({{2, 1, 30}}, line);
  EXPECT_EQ(hall.simulator.route_from_worker(hall.state, WorkerId(0), kEast).ticks, -1);
  hall.send(kGoEast);
  EXPECT_TRUE(hall.worker().no_way);
  hall.run_to(60);
  EXPECT_EQ(hall.ticks(Type::kTaskEnd), std::vector<Tick>{30 + 9});
}

TEST(Zones, WhoIsInsideMayLeave) {
  LineModel line = test::hall_line();
  line.zones.push_back(test::rectangle_zone("west_end", 0, 1, 0, 4));
  test::walk_on_cells(line, 10, 5);
  Hall hall({{2, 1, 100}}, line);
  hall.send(kGoEast);
  hall.run_to(60);
  EXPECT_EQ(hall.ticks(Type::kTaskEnd), std::vector<Tick>{10});
}

TEST(Zones, OneThatOpensShortensTheWay) {
  // On the detour it has gone one cell to the right, so that no metre was lost.
  const Hall early = walked_east({{kMiddle, 3, 4}});
  EXPECT_EQ(early.ticks(Type::kReroute), (std::vector<Tick>{3, 4}));
  EXPECT_EQ(early.ticks(Type::kTaskEnd), std::vector<Tick>{10});
  EXPECT_EQ(early.worker().travel_mm, 9'000);
  EXPECT_EQ(early.worker().travel_ticks, 9);
  // Past the corner there is nothing to gain.
  const Hall late = walked_east({{kMiddle, 3, 13}});
  EXPECT_EQ(late.ticks(Type::kReroute), std::vector<Tick>{3});
  EXPECT_EQ(late.ticks(Type::kTaskEnd), std::vector<Tick>{14});
}

TEST(Zones, AWorkerThatWaitsForAWayIsNoDeadlockAndNothingElseKeepsARunAlive) {
  LineModel line = test::hall_line();
  const auto never = [](Task& task) {
    task.when = {.any_of = {{Comparison{.terms = {{{VariableKind::kPlaceCount, 0}, 1}},
                                        .constant = -1,
                                        .relation = Relation::kGreaterEqual}}},
                 .text = "never >= 1"};
  };
  for (std::size_t t = 1; t < line.tasks.size(); ++t) never(line.tasks[t]);
  Hall waiting({{kWall, 1, 20}}, line);
  waiting.send(kGoEast);
  EXPECT_EQ(waiting.simulator.advance(waiting.state), RunStatus::kDecision);
  EXPECT_EQ(waiting.state.now, 29);
  for (Task& task : line.tasks) never(task);
  Hall dead({{kWall, 100, 200}}, line);
  EXPECT_EQ(dead.simulator.advance(dead.state), RunStatus::kDeadlock);
  EXPECT_EQ(dead.state.now, 1);
}

TEST(Zones, SeveralThatChangeAtOnceAreOneChange) {
  // The wall opens in the tick in which the middle closes: there is a way round all the time.
  const Hall hall = walked_east({{kMiddle, 5, 200}, {kWall, 3, 5}});
  EXPECT_EQ(hall.ticks(Type::kZone), (std::vector<Tick>{3, 5, 5}));
  EXPECT_EQ(hall.ticks(Type::kBlocked), std::vector<Tick>{3});
  EXPECT_EQ(hall.ticks(Type::kReroute), std::vector<Tick>{5});
  EXPECT_EQ(hall.ticks(Type::kTaskEnd), std::vector<Tick>{5 + 11});
}

TEST(Zones, ClosuresOfARunAreJoinedAndChecked) {
  LineModel line = test::hall_line();
  line.zones[0].closed = {{10, 20}, {30, 40}};
  const RunSetup setup =
      sample_setup(line, {.closures = {{kMiddle, 15, 25}, {kMiddle, 40, 45}, {kWall, 1, 2}}}, 1);
  EXPECT_EQ(setup.closures,
            (std::vector<Closure>{{kMiddle, 10, 25}, {kMiddle, 30, 45}, {kWall, 1, 2}}));
  for (const Closure& wrong : {Closure{7, 1, 2}, {-1, 1, 2}, {0, 0, 2}, {0, 3, 3}}) {
    EXPECT_THROW(static_cast<void>(sample_setup(line, {.closures = {wrong}}, 1)), ScenarioError);
  }
}

/// Everything of the log that a reader sees.
std::vector<std::vector<double>> facts(const EventLog& log) {
  std::vector<std::vector<double>> all;
  for (const LogEvent& e : log.events) {
    all.push_back({double(e.tick), double(e.type), double(e.a), double(e.b), double(e.c),
                   double(e.d), double(e.e), double(e.until), e.course.origin.x_m,
                   e.course.origin.y_m, double(e.course.planned_with)});
  }
  return all;
}

TEST(Zones, AContinuedCopyIsTheOriginalAtEveryTick) {
  const std::vector<Closure> closures = {{kMiddle, 3, 6}, {kMiddle, 20, 40}, {kWall, 9, 12}};
  const auto finish = [](Hall& hall, SimulationState& state, EventLog& log) {
    hall.simulator.advance(state, &log);
    Assignment back{TaskId(kGoWest)};
    back.members[0] = 0;
    hall.simulator.assign(state, back, &log);
    hall.simulator.advance_to(state, 80, &log);
  };
  Hall whole(closures);
  whole.send(kGoEast);
  finish(whole, whole.state, whole.log);
  ASSERT_GE(whole.events(Type::kReroute).size(), 2U);
  for (Tick tick = 1; tick < 12; ++tick) {
    Hall hall(closures);
    hall.send(kGoEast);
    hall.run_to(tick);
    SimulationState copy = hall.state;
    EventLog log = hall.log;
    finish(hall, copy, log);
    EXPECT_EQ(facts(log), facts(whole.log)) << tick;
    EXPECT_EQ(copy.workers[0].travel_mm, whole.worker().travel_mm) << tick;
  }
}

}  // namespace
}  // namespace linewright
