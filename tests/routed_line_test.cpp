// The duct line with routes from its map, against the travel times of the published system.

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "linewright/scenario/load.hpp"
#include "support.hpp"

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

double residual_rms(const std::vector<Recorded>& ways, double speed_mps) {
  double sum = 0.0;
  for (const Recorded& way : ways) {
    const double error = std::ceil(way.metres / speed_mps - 1e-9) - way.ticks;
    sum += error * error;
  }
  return std::sqrt(sum / static_cast<double>(ways.size()));
}

TEST(DuctLineRouted, FindsEveryRouteOfBothKinds) {
  const Scenario scenario = load_scenario(LINEWRIGHT_SOURCE_DIR "/scenarios/duct_line_routed.yaml");
  ASSERT_EQ(scenario.routes.size(), 2U);
  for (const auto& routes : scenario.routes) {
    ASSERT_TRUE(routes.has_value());
    EXPECT_EQ(routes->routes.pairs(), 90U);
    EXPECT_EQ(routes->routes.failed(), 0U);
  }
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

}  // namespace
}  // namespace linewright
