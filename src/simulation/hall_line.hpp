#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "fake_ways.hpp"
#include "linewright/simulation/simulator.hpp"

// A line for tests of ways: a hall of 10 x 5 cells with stations `west` (0, 2), `east` (9, 2) and
// `south` (4, 0); task 0 sends a human east, task 1 west, task 2 south, task 3 works where it is.
namespace linewright::test {

inline constexpr std::int32_t kMiddle = 0;  ///< zone around (5, 2): the straight way leads through
inline constexpr std::int32_t kWall = 1;    ///< zone across the hall at x = 7
inline constexpr StationId kWest(0);
inline constexpr StationId kEast(1);
inline constexpr StationId kSouth(2);

inline LineModel hall_line() {
  LineModel line;
  line.name = "hall";
  line.worker_kinds = {{.name = "human", .count = {1, 2}}};
  const auto station = [&](const char* name, double x, double y) {
    line.stations.push_back({.name = name, .poses = {Pose2{x, y, 0.0}}, .slots = {1}});
  };
  station("west", 0, 2);
  station("east", 9, 2);
  station("south", 4, 0);
  line.zones = {rectangle_zone("middle", 4, 6, 1, 3), rectangle_zone("wall", 7, 7, 0, 4)};
  line.places = {{.name = "never", .of = "part"},
                 {.name = "stock", .of = "part", .initial = {9, 0}}};
  line.places.push_back({.name = "shelf", .of = "part"});
  const auto task = [&](const char* name, std::vector<Action> actions) {
    Task made{.name = name,
              .number = static_cast<std::int32_t>(line.tasks.size()) + 1,
              .crew = {{.role = "human", .worker = WorkerKindId(0)}}};
    made.max_running = 2;
    made.steps = {{{{.slot = 0, .actions = std::move(actions)}}}};
    line.tasks.push_back(made);
  };
  task("go_east", {{.what = GoAction{kEast}}});
  task("go_west", {{.what = GoAction{kWest}}});
  task("go_south", {{.what = GoAction{kSouth}}});
  task("work",
       {{.what = TransferAction{.source = {PlaceId(1)}, .destination = {PlaceId(2)}, .takes = 3}}});
  line.order = {.product = "part", .quantity = 1, .finished_in = PlaceId(0)};
  line.order.done_when = {.any_of = {{Comparison{.terms = {{{VariableKind::kPlaceCount, 0}, 1}},
                                                 .constant = -1,
                                                 .relation = Relation::kGreaterEqual}}},
                          .text = "never >= 1"};
  line.horizon = {{{1'000, 500}}};
  walk_on_cells(line, 10, 5);
  return line;
}

/// One run of such a line, with its log.
struct Hall {
  explicit Hall(std::vector<Closure> closures, LineModel line = hall_line(),
                std::vector<StationId> start = {kWest})
      : owner(
            std::make_shared<const Simulator>(std::make_shared<const LineModel>(std::move(line)))),
        simulator(*owner) {
    setup.worker_start = {std::move(start)};
    setup.order = 1;
    setup.horizon = 500;
    setup.closures = std::move(closures);
    simulator.reset(state, setup, &log);
  }

  bool send(int task, int worker = 0) {
    Assignment assignment{TaskId(task)};
    assignment.members[0] = static_cast<std::int16_t>(worker);
    return simulator.assign(state, assignment, &log);
  }
  void run_to(Tick tick) { simulator.advance_to(state, tick, &log); }

  [[nodiscard]] std::vector<LogEvent> events(LogEvent::Type type) const {
    std::vector<LogEvent> found;
    for (const LogEvent& event : log.events) {
      if (event.type == type) found.push_back(event);
    }
    return found;
  }
  [[nodiscard]] std::vector<Tick> ticks(LogEvent::Type type) const {
    std::vector<Tick> found;
    for (const LogEvent& event : events(type)) found.push_back(event.tick);
    return found;
  }
  [[nodiscard]] const WorkerState& worker(std::size_t id = 0) const { return state.workers[id]; }
  [[nodiscard]] Pose2 pose(Tick tick) const {
    return simulator.worker_pose(state, WorkerId(0), tick);
  }

  std::shared_ptr<const Simulator> owner;  ///< copies share it
  const Simulator& simulator;
  RunSetup setup;
  SimulationState state;
  EventLog log;
};

}  // namespace linewright::test
