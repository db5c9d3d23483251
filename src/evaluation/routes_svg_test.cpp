#include "linewright/evaluation/routes_svg.hpp"

#include <gtest/gtest.h>

#include "../base/xml_check.hpp"
#include "label_places.hpp"
#include "linewright/scenario/load.hpp"
#include "routes_view.hpp"

namespace linewright {
namespace {

/// Three stations for either kind; the robot's `far` lies behind a gap that is too narrow for it.
constexpr const char* kCell = R"(
schema: line/1
name: cell
horizon: 100
order: {product: box, quantity: 1, finished_in: done}
workers:
  human: {count: 1, radius_m: 0.2, start: [a]}
  robot: {count: 1, footprint_m: [1.0, 0.8], turning_radius_m: 0.6, start: [a]}
stations:
  a:   {human: [2, 2, 0], robot: [2, 3, 0]}
  b:   {human: [8, 2, 1.5708], robot: [8, 3, 1.5708]}
  far: {human: [14, 2, 3.1416], robot: [14, 4, 0]}
places:
  stock: {of: box, initial: order, at: a}
  done:  {of: box, at: b}
tasks:
  carry:
    crew: {human: 1}
    steps: [{human: [{go: a}, {go: b}, {transfer: [stock, done], takes: 2}]}]
map:
  bounds: [0, 16, 0, 8]
  cell_m: 0.1
  obstacles:
    wall: [10, 10.5, 0.7, 8]
    table: {polygon: [[4, 1], [6, 1], [6.5, 3], [5, 5], [4, 3]]}
travel: {human: hybrid_a_star, robot: hybrid_a_star}
)";

const Scenario& cell() {
  static const Scenario kScenario = load_scenario_text(kCell, "cell.yaml");
  return kScenario;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

TEST(RoutesSvg, IsWellFormedAndHasOneGroupPerRouteAndOnePanelPerStart) {
  const Scenario& scenario = cell();
  const auto panels = showcase_panels(scenario);
  ASSERT_EQ(panels.size(), 4U);
  const std::string svg = routes_svg(scenario, panels);
  EXPECT_EQ(test::XmlCheck::fault(svg), "");
  EXPECT_EQ(count(svg, "<g class=\"panel-of\""), 4U);
  std::size_t found = 0;
  for (const RoutesPanel& panel : panels) {
    const RouteTable& routes = scenario.routes[panel.kind]->routes;
    for (std::size_t goal = 0; goal < routes.stops(); ++goal) {
      found += goal != panel.start && routes.path(panel.start, goal).found() ? 1 : 0;
    }
  }
  EXPECT_EQ(count(svg, "<g class=\"route\">"), found);
  EXPECT_EQ(count(svg, "cell: routes between stations"), 2U);  // heading and title
}

TEST(RoutesSvg, CrossesOutWhatCannotBeReached) {
  const Scenario& scenario = cell();
  ASSERT_FALSE(scenario.routes[1]->routes.path(0, 2).found());
  const std::string svg = routes_svg(scenario, {{1, 0}});
  EXPECT_EQ(count(svg, "class=\"cross\""), 1U);
  EXPECT_NE(svg.find(": 1 route, mean "), std::string::npos);
  EXPECT_NE(svg.find(" m, 1 missing"), std::string::npos);
}

TEST(RoutesSvg, HasTheSameBytesForAnyNumberOfThreads) {
  LoadOptions options;
  options.threads = 3;
  const Scenario& one = cell();
  const Scenario other = load_scenario_text(kCell, "cell.yaml", options);
  EXPECT_EQ(routes_svg(one, showcase_panels(one)), routes_svg(other, showcase_panels(other)));
}

TEST(RoutesSvg, EscapesEveryName) {
  Scenario scenario = cell();
  scenario.line.name = "<i>&\"'";
  scenario.map->obstacles[1].name = "<b>";
  scenario.routes[0]->request.kind = "a&b<";
  scenario.routes[0]->request.planner = "<p>";
  for (RouteStop& stop : scenario.routes[0]->request.stops) stop.name = "<\x01&" + stop.name;
  const std::string svg = routes_svg(scenario, {{0, 0}});
  EXPECT_EQ(test::XmlCheck::fault(svg), "");
  EXPECT_NE(svg.find("&lt;b&gt;"), std::string::npos);
  EXPECT_NE(svg.find("&lt;\xEF\xBF\xBD&amp;far"), std::string::npos);
}

TEST(RoutesSvg, DrawsTheCellsOfAMapFile) {
  Scenario scenario = cell();
  EXPECT_EQ(routes_svg(scenario, {{0, 0}}).find("class=\"cells\""), std::string::npos);
  scenario.map->occupancy = "hall.yaml";
  OccupancyGrid grid = *scenario.map->grid;
  grid.set({0, 0}, CellState::kUnknown);
  scenario.map->grid = std::make_shared<const OccupancyGrid>(std::move(grid));
  const std::string svg = routes_svg(scenario, {{0, 0}});
  EXPECT_EQ(test::XmlCheck::fault(svg), "");
  EXPECT_NE(svg.find("class=\"cells\""), std::string::npos);
  EXPECT_NE(svg.find("class=\"unknown\""), std::string::npos);
}

TEST(RoutesSvg, ShowcaseStartsAreTheTwoThatLieFarthestApartHere) {
  const auto panels = showcase_panels(cell());
  ASSERT_EQ(panels.size(), 4U);
  EXPECT_EQ(panels[0].kind, 0U);
  EXPECT_EQ(panels[0].start, 0U);
  EXPECT_EQ(panels[1].start, 2U);
  EXPECT_EQ(panels[2].kind, 1U);  // its third station has no routes
  EXPECT_EQ(panels[2].start, 0U);
  EXPECT_EQ(panels[3].start, 1U);
}

TEST(RoutesView, DrawsArcsExactlyAndTellsBackwardsPieces) {
  const routes::View view = routes::view_of({0.0, 66.0, 0.0, 52.0});  // 10 pixels per metre
  const Path path{.status = PathStatus::kFound,
                  .start = {10.0, 10.0, 0.0},
                  .turning_radius_m = 2.0,
                  .segments = {{PathSegment::Kind::kStraight, 3.0},
                               {PathSegment::Kind::kLeft, 3.14159265358979},
                               {PathSegment::Kind::kTurn, 1.0},
                               {PathSegment::Kind::kRight, -1.0}}};
  const routes::DrawnPath lines = routes::drawn(path, view);
  EXPECT_EQ(lines.forwards, "M108 428L138 428A20 20 0 0 0 158 408");
  EXPECT_TRUE(lines.backwards.starts_with("M158 408A20 20 0 0 0 ")) << lines.backwards;
  const Point2 back = view.point(view.at({3.0, 4.0}));
  EXPECT_NEAR(back.x_m, 3.0, 1e-9);
  EXPECT_NEAR(back.y_m, 4.0, 1e-9);
}

TEST(LabelPlaces, NoNameCoversAnotherOrADotWhileThereIsRoom) {
  std::vector<labels::Anchor> anchors;
  for (int i = 0; i < 12; ++i) {
    anchors.push_back({150.0 + 14.0 * (i % 4), 150.0 + 16.0 * (i / 4), 4.0, 50.0, 12.0});
  }
  const auto places = labels::Placer(400.0, 400.0).place(anchors);
  ASSERT_EQ(places.size(), anchors.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    const labels::Box& box = places[i].box;
    EXPECT_GE(box.x0, 0.0);
    EXPECT_LE(box.y1, 400.0);
    for (std::size_t j = 0; j < places.size(); ++j) {
      const labels::Anchor& a = anchors[j];
      EXPECT_FALSE(box.meets({a.x - 4.0, a.y - 4.0, a.x + 4.0, a.y + 4.0})) << i << " " << j;
      EXPECT_TRUE(i == j || !box.meets(places[j].box)) << i << " " << j;
    }
  }
}

}  // namespace
}  // namespace linewright
