#include "linewright/evaluation/hall_scene.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "small_log.hpp"

namespace linewright {
namespace {

HallScene small_scene(Tick tick) { return hall_scene(test::read_text(test::small_log()), tick); }

void expect_at(const Pose2& pose, double x, double y) {
  EXPECT_NEAR(pose.x_m, x, 1e-9);
  EXPECT_NEAR(pose.y_m, y, 1e-9);
}

TEST(HallScene, BeforeTheFirstTickEverythingIsAtItsStart) {
  const HallScene scene = small_scene(0);
  expect_at(scene.workers[0].pose, 1.5, 2.0);
  expect_at(scene.workers[1].pose, 0.0, 0.0);
  expect_at(scene.carriers[0].pose, 5.0, 6.0);  // where robots stand: a robot moves it
  EXPECT_FALSE(scene.workers[0].doing);
  EXPECT_TRUE(scene.workers[0].ahead.empty());
  EXPECT_EQ(scene.tokens, (std::vector<std::int64_t>{2, 0, 0, 0}));
  EXPECT_EQ(scene.decisions, 0);
}

TEST(HallScene, WorkersAreWhereTheirWayIsAtThatTime) {
  // 2 ... 6 by (3, 3) at half of the time.
  EXPECT_FALSE(small_scene(2).workers[0].moving);
  expect_at(small_scene(3).workers[0].pose, 2.25, 2.5);
  const SceneWorker half = small_scene(4).workers[0];
  expect_at(half.pose, 3.0, 3.0);
  EXPECT_NEAR(half.pose.heading_rad, 0.6, 1e-9);
  EXPECT_TRUE(half.moving);
  ASSERT_EQ(half.ahead.size(), 2U);
  EXPECT_EQ(half.ahead[1].x_m, 5.0);
  EXPECT_EQ(small_scene(3).workers[0].ahead.size(), 3U);
  expect_at(small_scene(6).workers[0].pose, 5.0, 5.0);
  EXPECT_TRUE(small_scene(6).workers[0].ahead.empty());
}

TEST(HallScene, WithoutAPathTheWayIsTheStraightLine) {
  // From (0, 0) to (5, 6) in ticks 3 ... 10.
  const SceneWorker robot = small_scene(4).workers[1];
  expect_at(robot.pose, 5.0 / 7.0, 6.0 / 7.0);
  EXPECT_NEAR(robot.pose.heading_rad, std::atan2(6.0, 5.0), 1e-9);
  ASSERT_EQ(robot.ahead.size(), 2U);
}

TEST(HallScene, CarriersAreWhereTheyAreHeldOrWerePutDown) {
  const HallScene held = small_scene(12);
  EXPECT_EQ(held.carriers[0].holder, WorkerId(1));
  EXPECT_EQ(held.workers[1].carrier, CarrierId(0));
  expect_at(held.carriers[0].pose, 5.0, 6.0);
  const HallScene down = small_scene(16);
  EXPECT_FALSE(down.carriers[0].holder);
  EXPECT_FALSE(down.workers[1].carrier);
  EXPECT_EQ(down.carriers[0].berth, PlaceId(3));
}

TEST(HallScene, ItemsCountAtTheirSourceUntilTheyArePutDown) {
  EXPECT_EQ(small_scene(12).tokens[0], 2);
  const HallScene in_cage = small_scene(13);
  EXPECT_EQ(in_cage.tokens[0], 1);
  EXPECT_EQ(in_cage.carriers[0].items, 1);
  EXPECT_EQ(in_cage.carriers[0].of, "box");
  const HallScene on_table = small_scene(15);
  EXPECT_EQ(on_table.carriers[0].items, 1);
  EXPECT_EQ(small_scene(16).carriers[0].items, 0);
  EXPECT_EQ(small_scene(16).carriers[0].of, "");
  EXPECT_EQ(small_scene(16).tokens[1], 0);  // put down, and taken by `grip` in the same tick
}

TEST(HallScene, ProductsAppearWhenTheirOperationEnds) {
  EXPECT_EQ(small_scene(31).tokens[2], 0);
  EXPECT_EQ(small_scene(32).tokens[2], 1);
}

TEST(HallScene, SaysWhatEveryoneDoesAsTheGanttChart) {
  const HallScene scene = small_scene(4);
  ASSERT_TRUE(scene.workers[0].doing);
  EXPECT_EQ(scene.workers[0].doing->kind, GanttKind::kTravel);
  EXPECT_EQ(scene.workers[0].doing->what, "walk desk → rack");
  EXPECT_EQ(scene.workers[0].doing->decision, 1);
  EXPECT_EQ(small_scene(11).workers[0].doing->what, "move box stock → cage.0");
  EXPECT_EQ(small_scene(8).workers[0].doing->kind, GanttKind::kWaiting);
  EXPECT_FALSE(small_scene(19).workers[0].doing);
}

TEST(HallScene, MachinesWorkHoldAndRecover) {
  EXPECT_FALSE(small_scene(10).machines[0]);
  EXPECT_EQ(small_scene(17).machines[1]->kind, GanttKind::kWorking);
  EXPECT_EQ(small_scene(25).machines[1]->kind, GanttKind::kHeld);
  EXPECT_EQ(small_scene(25).machines[1]->what, "held between grip and let_go");
  EXPECT_EQ(small_scene(25).machines[0]->what, "punch by human.0 · operate (decision 2)");
  EXPECT_EQ(small_scene(29).machines[0]->kind, GanttKind::kRecovering);
}

TEST(HallScene, ATickBeyondTheEndIsTheEnd) {
  EXPECT_EQ(small_scene(1000).tick, 32);
  EXPECT_EQ(small_scene(1000).decisions, 2);
}

TEST(HallScene, WaysThatAreReplacedOrBlockedEndWhereTheLogSays) {
  const LogDocument log = test::read_text(test::zones_log());
  const HallScene turned = hall_scene(log, 4);
  expect_at(turned.workers[1].pose, 2.0, 0.0);
  EXPECT_TRUE(turned.closed[0]);
  expect_at(hall_scene(log, 12).workers[1].pose, 3.5, 3.0);  // half of the new way's time
  const HallScene blocked = hall_scene(log, 9);
  expect_at(blocked.workers[0].pose, 3.0, 3.0);
  EXPECT_FALSE(blocked.workers[0].moving);
  EXPECT_TRUE(blocked.workers[0].ahead.empty());
  EXPECT_EQ(blocked.workers[0].doing->what, "wait for a way to rack: zone gate closed");
  EXPECT_FALSE(hall_scene(log, 13).closed[0]);
}

}  // namespace
}  // namespace linewright
