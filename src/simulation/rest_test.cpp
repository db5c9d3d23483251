#include <gtest/gtest.h>

#include "hall_line.hpp"

namespace linewright {
namespace {

using test::Hall;
using test::kEast;
using test::kMiddle;
using test::kSouth;
using test::kWall;
using test::kWest;
using Type = LogEvent::Type;

constexpr int kGoEast = 0;
constexpr int kGoWest = 1;
constexpr int kGoSouth = 2;
constexpr int kWork = 3;

LineModel resting_line(std::vector<StationId> rest, Tick after) {
  LineModel line = test::hall_line();
  line.worker_kinds[0].rest = std::move(rest);
  line.worker_kinds[0].rest_after = after;
  return line;
}

/// The same without ways: straight lines, measured.
LineModel measured_line(Tick after) {
  LineModel line = resting_line({kEast}, after);
  line.zones.clear();
  line.ways = nullptr;
  TravelTable table(3);
  for (const auto& [from, to, ticks] : {std::tuple{kWest, kEast, 10},
                                        {kEast, kWest, 10},
                                        {kWest, kSouth, 4},
                                        {kSouth, kWest, 4},
                                        {kEast, kSouth, 7},
                                        {kSouth, kEast, 7}}) {
    table.set(from, to, {ticks, static_cast<double>(ticks)});
  }
  line.travel = {table};
  return line;
}

TEST(Rest, AWorkerWithoutATaskGoesToTheNearestStationAfterAWhile) {
  Hall hall({}, resting_line({kEast, kSouth}, 5));
  hall.run_to(40);
  const auto goes = hall.events(Type::kGo);
  ASSERT_EQ(goes.size(), 1U);
  EXPECT_EQ(goes[0].tick, 5);
  EXPECT_EQ(goes[0].b, -1);
  EXPECT_EQ(goes[0].d, kSouth.value);  // 6 cells against 9
  EXPECT_EQ(goes[0].until, 11);
  EXPECT_EQ(hall.worker().rest_ticks, 6);
  EXPECT_EQ(hall.worker().travel_mm, 6'000);
  EXPECT_TRUE(hall.worker().free());
}

TEST(Rest, StaysWhereItIsWhenThatIsAPlaceToRest) {
  Hall hall({}, resting_line({kEast, kWest}, 5));
  hall.run_to(40);
  EXPECT_TRUE(hall.events(Type::kGo).empty());
}

TEST(Rest, CountsFromTheEndOfTheTask) {
  Hall hall({}, resting_line({kWest}, 5));
  hall.send(kGoEast);  // there at 10
  hall.run_to(60);
  const auto goes = hall.events(Type::kGo);
  ASSERT_EQ(goes.size(), 2U);
  EXPECT_EQ(goes[1].tick, 15);
  Hall busy({}, resting_line({kWest}, 5));
  busy.send(kGoEast);
  busy.run_to(13);
  busy.send(kGoSouth);  // at 14, a tick before it would have left; 7 cells
  busy.run_to(21);
  EXPECT_EQ(busy.events(Type::kGo).size(), 2U);
}

TEST(Rest, IsNothingThatARunWaitsFor) {
  LineModel line = resting_line({kEast}, 50);
  line.tasks.clear();
  Hall hall({}, line);
  EXPECT_EQ(hall.simulator.advance(hall.state), RunStatus::kDeadlock);
  EXPECT_EQ(hall.state.now, 1);
}

TEST(Rest, CalledOnTheWayItContinuesFromWhereItIs) {
  for (Tick tick = 3; tick <= 16; ++tick) {  // before it leaves, under way, and when it is there
    for (const int task : {kGoEast, kGoWest, kGoSouth}) {
      Hall hall({}, resting_line({kEast}, 4));
      hall.run_to(tick);
      const StationId to = task == kGoEast ? kEast : task == kGoWest ? kWest : kSouth;
      const Leg promised = hall.simulator.route_from_worker(hall.state, WorkerId(0), to);
      const Pose2 pose = hall.pose(tick + 1);
      ASSERT_TRUE(hall.send(task));
      EXPECT_EQ(promised.ticks, hall.worker().arrive - (tick + 1)) << tick << ' ' << task;
      EXPECT_EQ(static_cast<std::int64_t>(promised.metres * 1000), hall.worker().way_mm);
      const Point2 goal = hall.simulator.line().stations[to.index()].poses[0]->point();
      EXPECT_EQ(promised.ticks, std::abs(goal.x_m - pose.x_m) + std::abs(goal.y_m - pose.y_m));
      EXPECT_EQ(hall.pose(tick + 1).x_m, pose.x_m);
      const auto walked = static_cast<std::int64_t>(std::clamp(tick + 1 - 4, 0, 9) * 1000);
      EXPECT_EQ(hall.worker().travel_mm, walked + hall.worker().way_mm) << tick << ' ' << task;
      EXPECT_EQ(hall.worker().rest_ticks, walked / 1000);
      hall.run_to(60);
      EXPECT_EQ(hall.ticks(Type::kTaskEnd), std::vector<Tick>{tick + 1 + promised.ticks});
    }
  }
}

TEST(Rest, WithMeasuredTimesItGoesOnOrBackWhicheverIsSooner) {
  // West to east takes 10 ticks; south is 4 from west and 7 from east.
  for (Tick gone = 1; gone < 10; ++gone) {
    Hall hall({}, measured_line(1));
    hall.run_to(gone);  // left at 1; the task starts at gone + 1
    const Leg promised = hall.simulator.route_from_worker(hall.state, WorkerId(0), kSouth);
    ASSERT_TRUE(hall.send(kGoSouth));
    const Tick back = gone + 4;
    const Tick on = 10 - gone + 7;
    EXPECT_EQ(promised.ticks, std::min(back, on)) << gone;
    EXPECT_DOUBLE_EQ(promised.metres, promised.ticks);
    EXPECT_EQ(hall.worker().arrive, gone + 1 + promised.ticks) << gone;
    EXPECT_EQ(hall.worker().from, back < on ? kWest.value : kEast.value) << gone;
    EXPECT_EQ(hall.worker().travel_mm, (gone + promised.ticks) * 1000);
    // It is where it was, then at the station it goes back or on to, then at the goal.
    EXPECT_NEAR(hall.pose(gone + 1).x_m, 0.9 * gone, 1e-9);
    const Tick via = gone + 1 + (back < on ? gone : 10 - gone);
    EXPECT_NEAR(hall.pose(via).x_m, back < on ? 0.0 : 9.0, 1e-9);
    EXPECT_NEAR(hall.pose(hall.worker().arrive).y_m, 0.0, 1e-9);
    hall.run_to(60);
    EXPECT_EQ(hall.ticks(Type::kTaskEnd), std::vector<Tick>{gone + 1 + promised.ticks});
  }
}

TEST(Rest, ATaskThatBeginsWithoutAWayBeginsWhenItHasArrived) {
  Hall hall({}, resting_line({kEast}, 1));
  hall.run_to(4);
  hall.send(kWork);
  EXPECT_EQ(hall.worker().phase, WorkerState::Phase::kArriving);
  hall.run_to(60);
  EXPECT_EQ(hall.ticks(Type::kTransfer), std::vector<Tick>{10});
  EXPECT_EQ(hall.ticks(Type::kTaskEnd), std::vector<Tick>{13});
}

TEST(Rest, AZoneReroutesAndStopsAFreeWorkerToo) {
  Hall round({{kMiddle, 3, 100}}, resting_line({kEast}, 1));
  round.run_to(60);
  ASSERT_EQ(round.events(Type::kReroute).size(), 1U);
  EXPECT_EQ(round.events(Type::kReroute)[0].b, -1);
  EXPECT_EQ(round.worker().arrive, 14);
  EXPECT_EQ(round.worker().rest_ticks, 13);

  Hall stopped({{kWall, 3, 30}}, resting_line({kEast}, 1));
  stopped.run_to(20);
  EXPECT_TRUE(stopped.worker().free());
  EXPECT_EQ(stopped.pose(20).x_m, 2.0);
  // Called from there it goes from there.
  EXPECT_EQ(stopped.simulator.route_from_worker(stopped.state, WorkerId(0), kWest).ticks, 2);
  Hall called = stopped;
  called.send(kGoWest);
  called.run_to(60);
  EXPECT_EQ(called.ticks(Type::kTaskEnd), std::vector<Tick>{23});
  // Work that begins without a way waits until it has arrived where it rests.
  Hall works = stopped;
  works.send(kWork);
  works.run_to(60);
  EXPECT_EQ(works.ticks(Type::kTransfer), std::vector<Tick>{30 + 7});
  stopped.run_to(60);
  EXPECT_EQ(stopped.worker().arrive, 37);
}

TEST(Rest, LeavesLaterWhenThereIsNoWayYet) {
  Hall hall({{kWall, 1, 30}}, resting_line({kEast}, 5));
  hall.run_to(60);
  ASSERT_EQ(hall.events(Type::kGo).size(), 1U);
  EXPECT_EQ(hall.events(Type::kGo)[0].tick, 30);
  EXPECT_TRUE(hall.events(Type::kBlocked).empty());
}

TEST(Rest, AClosureInTheTickOfTheTaskIsInThePromise) {
  for (Tick tick = 2; tick <= 9; ++tick) {
    Hall hall({{kMiddle, tick + 1, 100}}, resting_line({kEast}, 1));
    hall.run_to(tick);
    const Leg promised = hall.simulator.route_from_worker(hall.state, WorkerId(0), kEast);
    hall.send(kGoEast);
    EXPECT_EQ(hall.worker().arrive, tick + 1 + promised.ticks) << tick;
  }
}

TEST(Rest, SnapsToTheStationNearestInAStraightLine) {
  Hall hall({}, resting_line({kEast}, 1));
  EXPECT_EQ(hall.simulator.snapped_station(hall.state, WorkerId(0)), kWest);
  hall.run_to(3);  // at (2, 2): 2 m to west, 2.8 m to south
  EXPECT_EQ(hall.simulator.snapped_station(hall.state, WorkerId(0)), kWest);
  hall.run_to(5);
  EXPECT_EQ(hall.simulator.snapped_station(hall.state, WorkerId(0)), kSouth);
  hall.run_to(9);
  EXPECT_EQ(hall.simulator.snapped_station(hall.state, WorkerId(0)), kEast);
  hall.run_to(30);
  EXPECT_EQ(hall.simulator.snapped_station(hall.state, WorkerId(0)), kEast);
}

}  // namespace
}  // namespace linewright
