// The routes of the duct line on its map, against what no route can be shorter than.

#include <gtest/gtest.h>

#include "../src/routing/any_angle_bound.hpp"
#include "linewright/routing/reeds_shepp.hpp"
#include "linewright/scenario/load.hpp"

namespace linewright {
namespace {

TEST(DuctHallRoutes, AreAllThereAndNoneIsShorterThanTheBound) {
  const Scenario scenario = load_scenario(LINEWRIGHT_SOURCE_DIR "/scenarios/duct_line_routed.yaml",
                                          {.route_cache = false, .threads = 2});
  std::size_t pairs = 0;
  for (const auto& kind : scenario.routes) {
    if (!kind) continue;
    const Mover& mover = kind->request.mover;
    const AnyAngleBound bound(*scenario.map->grid, mover.footprint.inscribed_m());
    double metres = 0.0;
    double least = 0.0;
    const std::vector<RouteStop>& stops = kind->request.stops;
    for (std::size_t from = 0; from < stops.size(); ++from) {
      for (std::size_t to = 0; to < stops.size(); ++to) {
        if (from == to) continue;
        ++pairs;
        SCOPED_TRACE(kind->request.kind + " " + stops[from].name + " -> " + stops[to].name);
        const Path& path = kind->routes.path(from, to);
        ASSERT_TRUE(path.found());
        double lower = bound.metres(stops[from].pose.point(), stops[to].pose.point());
        if (mover.turning_radius_m > 0.0) {
          lower = std::max(lower,
                           reeds_shepp_m(stops[from].pose, stops[to].pose, mover.turning_radius_m));
        }
        EXPECT_GE(path.metres(), lower - 1e-6);
        metres += path.metres();
        least += lower;
      }
    }
    EXPECT_LE(metres, 1.05 * least) << kind->request.kind;
  }
  EXPECT_EQ(pairs, 180U);
}

}  // namespace
}  // namespace linewright
