#include "linewright/planning/rules.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>

#include "task_facts.hpp"

namespace linewright {
namespace {

constexpr std::size_t kA = 0;  // task `fill_a`: quick, far away, feeds the slow machine
constexpr std::size_t kB = 1;  // task `fill_b`: slow, near, feeds the quick machine

/// A person fills two buffers from a heap; two machines make products of what lies there.
LineModel two_buffers() {
  LineModel line;
  line.name = "two_buffers";
  const StationId far(std::size_t{0});
  const StationId near(std::size_t{1});
  line.worker_kinds.push_back({.name = "human", .count = {1, 1}, .start = {near}});
  line.stations.push_back({"far", {Pose2{20, 0, 0}}, {1}});
  line.stations.push_back({"near", {Pose2{0, 0, 0}}, {1}});
  TravelTable table(2);
  table.set(far, near, {10, 20.0});
  table.set(near, far, {10, 20.0});
  line.travel.push_back(std::move(table));
  line.places.push_back({.name = "heap", .of = "blank", .initial = {10, 0}});
  line.places.push_back({.name = "buffer_a", .of = "blank", .capacity = 4, .at = far});
  line.places.push_back({.name = "buffer_b", .of = "blank", .capacity = 4, .at = near});
  line.places.push_back({.name = "shelf"});
  const auto add = [&](std::size_t index, StationId at, Tick by_hand, Tick by_machine) {
    const std::string name(1, static_cast<char>('a' + index));
    const PlaceId buffer(index + 1);
    line.machines.push_back({.name = "machine_" + name});
    line.operations.push_back({.name = "make_" + name,
                               .takes = by_machine,
                               .uses = {{MachineId(index), {}, {}}},
                               .consumes = {{buffer, 1}},
                               .produces = {{PlaceId(std::size_t{3}), 1}}});
    Task task{.name = "fill_" + name, .number = static_cast<std::int32_t>(index) + 1};
    task.crew = {{.role = "human", .worker = WorkerKindId(std::size_t{0})}};
    const TransferAction transfer{{PlaceId(std::size_t{0}), 0}, {buffer, 0}, by_hand};
    task.steps.push_back({{{0, {Action{GoAction{at}}, Action{transfer}}}}});
    line.tasks.push_back(task);
  };
  add(kA, far, 3, 30);
  add(kB, near, 12, 5);
  line.order = {.product = "thing", .quantity = 8, .finished_in = PlaceId(std::size_t{3})};
  line.order.done_when.any_of = {
      {{{{{VariableKind::kPlaceCount, 3}, 1}, {{VariableKind::kOrder, 0}, -1}},
        0,
        Relation::kGreaterEqual}}};
  line.horizon.by_order = {{1, 10'000}};
  return line;
}

class Rules : public ::testing::Test {
 protected:
  Rules() : simulator_(std::make_shared<const LineModel>(two_buffers())) {
    simulator_.reset(state_, sample_setup(simulator_.line(), {}, 1));
    simulator_.advance(state_);
  }

  std::size_t choice_of(const std::string& rule) {
    const auto planner = make_rule_planner(rule, simulator_);
    planner->reset(1);
    return planner->decide(state_, all_choices(simulator_, state_)).task->index();
  }

  /// One person does the task; then the next decision.
  void run(std::size_t task) {
    Assignment assignment{TaskId(task)};
    assignment.members[0] = 0;
    ASSERT_EQ(simulator_.explain_refusal(state_, assignment), "");
    ASSERT_TRUE(simulator_.assign(state_, assignment));
    simulator_.advance(state_);
  }

  Simulator simulator_;
  SimulationState state_;
};

TEST_F(Rules, KnowWorkTailAndBottleneckFromTheModel) {
  const planning::LineFacts facts = planning::facts_of(simulator_.line());
  EXPECT_EQ(facts.tasks[kA].work, 3.0);
  EXPECT_EQ(facts.tasks[kA].tail, 30.0);
  EXPECT_EQ(facts.tasks[kB].work, 12.0);
  EXPECT_EQ(facts.tasks[kB].tail, 5.0);
  EXPECT_EQ(facts.bottleneck, MachineId(kA));
  EXPECT_EQ(facts.tasks[kA].to_bottleneck, 0.0);
  EXPECT_EQ(facts.tasks[kB].to_bottleneck, planning::kNowhere);
  EXPECT_EQ(facts.pace[0], 3.0);
}

TEST_F(Rules, ChooseWhatTheirNamesSay) {
  EXPECT_EQ(choice_of("spt"), kA);
  EXPECT_EQ(choice_of("lpt"), kB);
  EXPECT_EQ(choice_of("mwkr"), kA);
  EXPECT_EQ(choice_of("nearest"), kB);
  EXPECT_EQ(choice_of("bottleneck_first"), kA);
}

TEST_F(Rules, FillTheBufferThatRunsDryFirst) {
  EXPECT_EQ(choice_of("critical_ratio"), kA);  // both are empty: the first one
  run(kA);
  run(kA);  // one lies in buffer a, one is in the machine
  ASSERT_EQ(simulator_.value(state_, {VariableKind::kPlaceCount, 1}), 1);
  EXPECT_EQ(choice_of("critical_ratio"), kB);
  EXPECT_EQ(choice_of("most_urgent_buffer"), kB);
}

TEST_F(Rules, FifoTakesTheTaskThatHasWaitedTheLongest) {
  const auto fifo = make_rule_planner("fifo", simulator_);
  fifo->reset(1);
  const auto next = [&] {
    return fifo->decide(state_, all_choices(simulator_, state_)).task->index();
  };
  EXPECT_EQ(next(), kA);
  run(kA);
  EXPECT_EQ(next(), kB);
  run(kB);
  EXPECT_EQ(next(), kA);
}

TEST_F(Rules, HaveNamesAndUnknownOnesNone) {
  EXPECT_EQ(dispatching_rules().size(), 8U);
  EXPECT_EQ(make_rule_planner("shortest", simulator_), nullptr);
}

}  // namespace
}  // namespace linewright
