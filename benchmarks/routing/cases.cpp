#include "cases.hpp"

#include <fmt/format.h>

#include "../../src/routing/random_hall.hpp"
#include "linewright/scenario/load.hpp"

namespace linewright::bench {

Mover long_robot() { return {Footprint::rectangle(1.4, 0.9), 0.8}; }
Mover round_robot() { return {Footprint::circle(0.4), 0.6}; }

Case random_case(std::int32_t size, std::size_t percent, const Mover& mover, std::size_t queries) {
  RandomStream random = RandomStream::derive(static_cast<std::uint64_t>(size), "hall", percent);
  Case made;
  made.name = fmt::format("{0} x {0}, {1} %", size, percent);
  made.grid = std::make_shared<const OccupancyGrid>(random_hall(random, size, size, 0.25, percent));
  made.map = std::make_shared<const ClearanceMap>(*made.grid);
  made.mover = mover;
  const double radius_m = mover.footprint.circumscribed_m();
  for (std::size_t i = 0; i < queries; ++i) {
    const Pose2 start = random_free_pose(random, *made.map, radius_m);
    made.queries.push_back({start, random_free_pose(random, *made.map, radius_m)});
  }
  return made;
}

DuctHall duct_hall() {
  const Scenario scenario = load_scenario(LINEWRIGHT_SOURCE_DIR "/scenarios/duct_line_routed.yaml",
                                          {.route_cache = false, .threads = 1});
  DuctHall hall;
  hall.grid = scenario.map->grid;
  hall.map = std::make_shared<const ClearanceMap>(*hall.grid);
  for (const auto& kind : scenario.routes) {
    if (kind) hall.requests.push_back(kind->request);
  }
  return hall;
}

Case hall_case(const DuctHall& hall, const RouteRequest& request, std::size_t stride) {
  Case made{"duct hall, " + request.kind, hall.grid, hall.map, request.mover, {}};
  std::size_t pair = 0;
  // Goal by goal, as route tables are built.
  for (std::size_t to = 0; to < request.stops.size(); ++to) {
    for (std::size_t from = 0; from < request.stops.size(); ++from) {
      if (from == to || pair++ % stride != 0) continue;
      made.queries.push_back({request.stops[from].pose, request.stops[to].pose});
    }
  }
  return made;
}

}  // namespace linewright::bench
