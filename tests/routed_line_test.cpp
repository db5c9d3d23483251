// The duct line with routes from its map, against the travel times of the published system.

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "linewright/allocation/allocator.hpp"
#include "linewright/evaluation/event_log_writer.hpp"
#include "linewright/planning/episode.hpp"
#include "linewright/planning/planner.hpp"
#include "linewright/scenario/load.hpp"
#include "linewright/simulation/simulator.hpp"

namespace linewright {
namespace {

/// A way whose time was read from logs: metres of our route, ticks of theirs.
struct Recorded {
  double metres;
  double ticks;
};

/// By worker kind.
std::map<std::string, std::vector<Recorded>> recorded_ways(const Scenario& scenario) {
  std::map<std::string, std::vector<Recorded>> ways;
  std::ifstream file(LINEWRIGHT_SOURCE_DIR "/tests/data/recorded_travel.txt");
  std::string line;
  while (std::getline(file, line)) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream words(line);
    std::string kind, from, to;
    double ticks = 0.0;
    words >> kind >> from >> to >> ticks;
    for (const auto& routes : scenario.routes) {
      if (!routes || routes->request.kind != kind) continue;
      const auto stop = [&](const std::string& name) {
        std::size_t i = 0;
        while (routes->request.stops[i].name != name) ++i;
        return i;
      };
      ways[kind].push_back({routes->routes.path(stop(from), stop(to)).metres(), ticks});
    }
  }
  return ways;
}

/// Ticks that our way takes longer than theirs.
double residual(const Recorded& way, double speed_mps) {
  return std::ceil(way.metres / speed_mps - 1e-9) - way.ticks;
}

double residual_rms(const std::vector<Recorded>& ways, double speed_mps) {
  double sum = 0.0;
  for (const Recorded& way : ways) sum += residual(way, speed_mps) * residual(way, speed_mps);
  return std::sqrt(sum / static_cast<double>(ways.size()));
}

TEST(DuctLineRouted, NoOtherSpeedMeetsTheRecordedTravelTimesBetter) {
  const Scenario scenario = load_scenario(LINEWRIGHT_SOURCE_DIR "/scenarios/duct_line_routed.yaml");
  const auto ways = recorded_ways(scenario);
  ASSERT_EQ(ways.at("human").size(), 26U);
  ASSERT_EQ(ways.at("robot").size(), 13U);
  const std::map<std::string, double> largest_rms{{"human", 2.65}, {"robot", 1.8}};
  for (const WorkerKind& kind : scenario.line.worker_kinds) {
    const double chosen = residual_rms(ways.at(kind.name), kind.speed_mps);
    EXPECT_LE(chosen, largest_rms.at(kind.name));
    for (double speed = 0.5; speed < 3.0; speed += 0.01) {
      EXPECT_LE(chosen, residual_rms(ways.at(kind.name), speed) + 0.02)
          << kind.name << " " << speed;
    }
  }
}

/// The figures of docs/routing.md.
TEST(DuctLineRouted, MostRecordedTravelTimesAreMetWithinATick) {
  const Scenario scenario = load_scenario(LINEWRIGHT_SOURCE_DIR "/scenarios/duct_line_routed.yaml");
  const auto ways = recorded_ways(scenario);
  const std::map<std::string, int> within_one{{"human", 15}, {"robot", 9}};
  const std::map<std::string, double> at_most{{"human", 6.0}, {"robot", 4.0}};
  for (const WorkerKind& kind : scenario.line.worker_kinds) {
    int near = 0;
    for (const Recorded& way : ways.at(kind.name)) {
      const double error = std::abs(residual(way, kind.speed_mps));
      near += error <= 1.0 ? 1 : 0;
      EXPECT_LE(error, at_most.at(kind.name));
    }
    EXPECT_EQ(near, within_one.at(kind.name));
  }
}

/// The duct line with two people and two robots, and the walkway closed from tick 70 on.
EventLog run_with_closed_walkway(const Scenario& scenario, Tick ticks) {
  const Simulator simulator(std::make_shared<const LineModel>(scenario.line));
  const auto planner = PlannerRegistry::make("first", simulator);
  const auto allocator = make_allocator("sap", simulator);
  RunOptions options;
  options.workers = {2, 2};
  if (ticks > 0) options.closures = {{0, 70, 70 + ticks}};
  SimulationState state;
  EventLog log;
  run_episode(simulator, state, sample_setup(simulator.line(), options, 1), 1, *planner, *allocator,
              {.log = &log});
  EXPECT_EQ(state.status, RunStatus::kFinished);
  return log;
}

TEST(DuctLineRouted, AZoneThatClosesInTheMiddleOfARunSendsWorkersAroundIt) {
  const Scenario scenario = load_scenario(LINEWRIGHT_SOURCE_DIR "/scenarios/duct_line_routed.yaml");
  ASSERT_EQ(scenario.line.zones[0].name, "walkway");
  const std::string open = event_log_text(scenario, run_with_closed_walkway(scenario, 0), 1.0);
  EXPECT_EQ(open.find("reroute"), std::string::npos);
  const EventLog log = run_with_closed_walkway(scenario, 200);
  int rerouted = 0;
  for (const LogEvent& event : log.events) {
    if (event.type != LogEvent::Type::kReroute || event.tick >= 270) continue;
    ++rerouted;
    const WorkerKindId kind(event.a < 2 ? 0 : 1);
    const auto path = course_path(scenario.line, event.course, {kind, {}, StationId(event.d), 1});
    ASSERT_FALSE(path.empty());
    EXPECT_FALSE(scenario.line.ways->crosses(kind, path, 0.0, 0));
  }
  EXPECT_GE(rerouted, 1);
  const std::string text = event_log_text(scenario, log, 1.0);
  EXPECT_NE(text.find(R"({"t":70,"event":"zone","zone":"walkway","closed":true})"),
            std::string::npos);
  EXPECT_NE(text.find(R"({"t":270,"event":"zone","zone":"walkway","closed":false})"),
            std::string::npos);
  EXPECT_NE(text.find(R"("event":"reroute")"), std::string::npos);
  EXPECT_EQ(text, event_log_text(scenario, run_with_closed_walkway(scenario, 200), 1.0));
}

}  // namespace
}  // namespace linewright
