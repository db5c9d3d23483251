#include "linewright/scenario/load.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#include "linewright/base/files.hpp"

namespace linewright {
namespace {

const std::string kFolder = std::string(LINEWRIGHT_SOURCE_DIR) + "/scenarios/";

/// A line with one of everything that the tests below change.
std::string small_line(const std::string& more = "", const std::string& order = "3") {
  return "schema: line/1\n"
         "name: small\n"
         "horizon: 100\n"
         "order: {product: p, quantity: " +
         order +
         ", finished_in: done}\n"
         "places: {stock: {of: x, initial: order}, done: {of: p}}\n"
         "operations: {make: {takes: 2, consumes: [stock], produces: [done]}}\n" +
         more;
}

std::string error_of(const std::string& text) {
  try {
    (void)load_scenario_text(text, "t.yaml");
  } catch (const ScenarioError& e) {
    return e.what();
  }
  return "no error";
}

template <class Entities>
auto named(const Entities& entities, const std::string& name) {
  const auto found = std::find_if(entities.begin(), entities.end(),
                                  [&](const auto& entity) { return entity.name == name; });
  EXPECT_NE(found, entities.end()) << name;
  return *found;
}

template <class Entities>
std::int32_t id_of(const Entities& entities, const std::string& name) {
  const auto found = std::find_if(entities.begin(), entities.end(),
                                  [&](const auto& entity) { return entity.name == name; });
  EXPECT_NE(found, entities.end()) << name;
  return static_cast<std::int32_t>(found - entities.begin());
}

TEST(LoadDuctLine, HasTheNumbersOfItsFile) {
  const Scenario scenario = load_scenario(kFolder + "duct_line.yaml");
  const LineModel& line = scenario.line;
  EXPECT_EQ(line.name, "duct_line");
  ASSERT_EQ(line.tasks.size(), 9U);
  for (std::size_t i = 0; i < line.tasks.size(); ++i) {
    EXPECT_EQ(line.tasks[i].number, static_cast<int>(i) + 1);
  }
  EXPECT_EQ(line.tasks[4].name, "load_flange.outer");
  EXPECT_EQ(named(line.operations, "clamp.inner").takes, 11);
  EXPECT_EQ(named(line.operations, "clamp.outer").takes, 10);
  EXPECT_EQ(line.horizon.ticks(5), 2000);
  EXPECT_EQ(line.horizon.ticks(6), 2500);
  EXPECT_EQ(line.horizon.ticks(99), 3000);
  EXPECT_EQ(named(line.places, "bend_stock").initial.value(7), 7);
}

TEST(LoadDuctLine, ResolvesMachinesThatMove) {
  const LineModel line = load_scenario(kFolder + "duct_line.yaml").line;
  const Machine gantry = named(line.machines, "inner_gantry");
  const auto position = [&](const char* name) {
    return static_cast<std::size_t>(
        std::find(gantry.positions.begin(), gantry.positions.end(), name) -
        gantry.positions.begin());
  };
  EXPECT_EQ(gantry.travel[position("duct_outer")][position("at_cage")], 11);
  EXPECT_EQ(gantry.travel[position("cut_part")][position("cut_part")], 0);
  EXPECT_EQ(gantry.travel[position("home")][position("at_cage")], -1);
  ASSERT_TRUE(gantry.homing.has_value());
  EXPECT_EQ(gantry.homing->takes[position("at_outer")], 13);
  EXPECT_EQ(gantry.homing->takes[position("home")], 0);
  EXPECT_EQ(gantry.homing->takes[position("cut_part")], -1);
  const Operation lift = named(line.operations, "lift_duct.outer");
  ASSERT_EQ(lift.claims.size(), 2U);
  EXPECT_EQ(lift.claims[0].from, static_cast<int>(position("duct_outer")));
  EXPECT_FALSE(lift.claims[0].to.has_value());
}

TEST(LoadDuctLine, ResolvesCrewsAndSteps) {
  const LineModel line = load_scenario(kFolder + "duct_line.yaml").line;
  const Task store = named(line.tasks, "store_ducts");
  ASSERT_EQ(store.crew.size(), 3U);
  EXPECT_FALSE(store.crew[0].join_late);
  EXPECT_TRUE(store.crew[1].join_late);
  EXPECT_EQ(store.crew[2].wanted, CarrierWanted::kBerth);
  EXPECT_EQ(store.crew[2].berth.value, id_of(line.places, "outfeed_berth"));
  const Task bring = named(line.tasks, "bring_flanges");
  ASSERT_EQ(bring.steps.size(), 4U);
  ASSERT_EQ(bring.steps[0].sequences.size(), 2U);
  EXPECT_EQ(bring.steps[0].sequences[1].actions.size(), 2U);
  const Action& unload = bring.steps[3].sequences[0].actions[0];
  const auto& transfer = std::get<TransferAction>(unload.what);
  EXPECT_EQ(unload.before, 1);
  EXPECT_EQ(transfer.repeat, TransferAction::kUntilBlocked);
  EXPECT_FALSE(transfer.source.place.has_value());
  EXPECT_EQ(transfer.source.slot, 2U);
  EXPECT_EQ(transfer.destination.place->value, id_of(line.places, "flange_table"));
}

TEST(LoadDuctLine, MeasuredWaysAreTakenAsTheyAre) {
  const LineModel line = load_scenario(kFolder + "duct_line.yaml").line;
  const StationId rack(id_of(line.stations, "flange_rack"));
  const StationId storage(id_of(line.stations, "storage"));
  EXPECT_EQ(line.travel[0].leg(rack, storage).ticks, 24);
  EXPECT_EQ(line.travel[0].leg(storage, rack).ticks, 25);
  EXPECT_DOUBLE_EQ(line.travel[1].leg(storage, rack).metres, 38.2);
  EXPECT_TRUE(line.travel[0].path(rack, storage).empty());
}

TEST(LoadDuctLine, RoutesOnItsMapAreAboutAsLongAsTheShortestWaysThatWereMeasured) {
  const LineModel measured = load_scenario(kFolder + "duct_line.yaml").line;
  const LineModel routed = load_scenario(kFolder + "duct_line_routed.yaml").line;
  // A robot also has to get into the lane: a way of 4 m can become one of 5.
  const double longest[] = {1.03, 1.36};
  const double mean[] = {1.0, 1.02};
  for (std::size_t kind = 0; kind < 2; ++kind) {
    double metres = 0.0;
    double expected = 0.0;
    for (std::size_t i = 0; i < measured.stations.size(); ++i) {
      for (std::size_t j = 0; j < measured.stations.size(); ++j) {
        const Leg& leg = measured.travel[kind].leg(StationId(i), StationId(j));
        if (i == j || leg.ticks < 0) continue;
        const double ratio =
            routed.travel[kind].leg(StationId(i), StationId(j)).metres / leg.metres;
        EXPECT_GE(ratio, 0.97) << i << " to " << j;
        EXPECT_LE(ratio, longest[kind]) << i << " to " << j;
        metres += ratio * leg.metres;
        expected += leg.metres;
      }
    }
    EXPECT_NEAR(metres / expected, mean[kind], 0.02);
  }
}

TEST(LoadDuctLine, PublishedLineDiffersInTheBerthOnly) {
  const Scenario line = load_scenario(kFolder + "duct_line.yaml");
  const Scenario published = load_scenario(kFolder + "duct_line_published.yaml");
  EXPECT_EQ(published.line.name, "duct_line_published");
  EXPECT_EQ(named(line.line.places, "outfeed_berth").berth->occupied, BerthOccupied::kOnArrival);
  EXPECT_EQ(named(published.line.places, "outfeed_berth").berth->occupied,
            BerthOccupied::kOnAssignment);
  EXPECT_NE(line.content_hash, published.content_hash);
  ASSERT_EQ(line.line.operations.size(), published.line.operations.size());
}

TEST(LoadScenario, DefaultGoalIsTheOrderInItsPlace) {
  const Order order = load_scenario_text(small_line(), "t.yaml").line.order;
  EXPECT_EQ(order.done_when.text, "done >= order");
  ASSERT_EQ(order.done_when.any_of.size(), 1U);
  EXPECT_EQ(order.done_when.any_of[0][0].terms.size(), 2U);
}

TEST(LoadScenario, OrderOfSectionsDoesNotMatter) {
  const std::string text =
      "operations: {make: {takes: 2, consumes: [stock], produces: [done], when: [crane.free == "
      "1]}}\n"
      "machines: {crane: {}}\n"
      "places: {done: {of: p}, stock: {of: x, initial: 2*order}}\n"
      "order: {finished_in: done, quantity: 3, product: p}\n"
      "horizon: 100\nname: small\nschema: line/1\n";
  const LineModel line = load_scenario_text(text, "t.yaml").line;
  EXPECT_EQ(line.operations[0].consumes[0].place, PlaceId(1));
  EXPECT_EQ(line.places[1].initial.value(3), 6);
}

TEST(LoadScenario, TasksAreOrderedByNumberAndNamedSoInConditions) {
  const std::string text = small_line(
      "workers: {human: {}}\n"
      "stations: {here: {human: [0, 0, 0]}}\n"
      "tasks:\n"
      "  late:  {number: 9, crew: {human: 1}, when: [early.done > 0], steps: [{human: {go: "
      "here}}]}\n"
      "  early: {number: 3, crew: {human: 1}, steps: [{human: {go: here}}]}\n"
      "milestones: {m: {task_end: late}}\n");
  const LineModel line = load_scenario_text(text, "t.yaml").line;
  EXPECT_EQ(line.tasks[0].name, "early");
  EXPECT_EQ(line.tasks[1].when.any_of[0][0].terms[0].variable,
            (Variable{VariableKind::kTaskDone, 0}));
  EXPECT_EQ(line.milestones[0].index, 1);
}

TEST(LoadScenario, StraightWaysAreRoundedUpToTicks) {
  const std::string text = small_line(
      "tick_s: 0.5\n"
      "workers: {human: {speed_mps: 2, start: [a]}}\n"
      "stations: {a: {human: [0, 0, 0]}, b: {human: [3, 4, 0]}, c: {human: [3, 4.1, 0]}}\n");
  const LineModel line = load_scenario_text(text, "t.yaml").line;
  EXPECT_EQ(line.travel[0].leg(StationId(0), StationId(1)).ticks, 5);
  EXPECT_EQ(line.travel[0].leg(StationId(0), StationId(2)).ticks, 6);
  EXPECT_DOUBLE_EQ(line.travel[0].leg(StationId(1), StationId(0)).metres, 5.0);
}

TEST(LoadScenario, WaysOnAMapLeadAroundObstaclesAndAreDrawn) {
  const std::string text = small_line(
      "workers: {robot: {speed_mps: 1, radius_m: 0.5}}\n"
      "stations: {a: {robot: [1, 1, 0]}, b: {robot: [9, 1, 0]}}\n"
      "map: {bounds: [0, 10, 0, 10], cell_m: 0.1, obstacles: {wall: [4, 6, 0, 7]}}\n");
  const LineModel line = load_scenario_text(text, "t.yaml").line;
  const Leg& leg = line.travel[0].leg(StationId(0), StationId(1));
  EXPECT_GT(leg.metres, 15.0);
  EXPECT_EQ(leg.ticks, static_cast<Tick>(std::ceil(leg.metres)));
  EXPECT_GE(line.travel[0].path(StationId(0), StationId(1)).size(), 4U);
}

TEST(LoadMap, ObstaclesOfEveryShapeAreInTheGrid) {
  const Scenario scenario =
      load_scenario_text(small_line("map:\n"
                                    "  bounds: [-2, 4, 1, 5]\n"
                                    "  cell_m: 0.5\n"
                                    "  obstacles:\n"
                                    "    short: [-2, -1, 1, 2]\n"
                                    "    tall: {rectangle: [3, 4, 4, 5], height_m: 2.5}\n"
                                    "    clockwise: {polygon: [[0, 1], [0, 3], [2, 1]]}\n"),
                         "t.yaml");
  ASSERT_TRUE(scenario.map);
  const HallMap& map = *scenario.map;
  EXPECT_EQ(map.bounds.x0_m, -2.0);
  EXPECT_EQ(map.bounds.y1_m, 5.0);
  EXPECT_EQ(map.cell_m, 0.5);
  EXPECT_TRUE(map.occupancy.empty());
  ASSERT_EQ(map.obstacles.size(), 3U);
  EXPECT_EQ(map.obstacles[0].height_m, 1.0);
  EXPECT_EQ(map.obstacles[1].height_m, 2.5);
  EXPECT_EQ(doubled_area_m2(map.obstacles[2].polygon), 4.0);
  const OccupancyGrid& grid = *map.grid;
  EXPECT_EQ(grid.columns(), 12);
  EXPECT_EQ(grid.rows(), 8);
  EXPECT_EQ(grid.count(CellState::kOccupied), 4U + 4U + 10U);
  EXPECT_TRUE(grid.blocked(grid.frame().cell_at({0.1, 2.6})));
}

TEST(LoadMap, TheMapFileOfTheDuctLineIsItsHall) {
  const std::string root = LINEWRIGHT_SOURCE_DIR;
  const Scenario drawn = load_scenario(kFolder + "duct_line.yaml");
  const Scenario read = load_scenario(root + "/tests/data/duct_line_on_map_file.yaml");
  EXPECT_EQ(read.map->occupancy, kFolder + "maps/duct_hall.yaml");
  EXPECT_EQ(read.map->grid->cells(), drawn.map->grid->cells());
  EXPECT_EQ(read.map->cell_m, drawn.map->cell_m);
  EXPECT_EQ(read.map->bounds.x0_m, drawn.map->bounds.x0_m);
  EXPECT_EQ(read.map->bounds.y1_m, drawn.map->bounds.y1_m);
  EXPECT_TRUE(read.map->obstacles.empty());
}

/// A folder with a scenario, the file it extends, and a map beside that.
class MapOfAnExtendedFile : public testing::Test {
 protected:
  void SetUp() override {
    write_file(folder_ + "/line.yaml", "schema: line/1\nextends: base/base.yaml\nname: child\n");
    write_file(folder_ + "/base/base.yaml", small_line("map:\n"
                                                       "  occupancy: maps/m.yaml\n"
                                                       "  obstacles: {box: [0, 1, 0, 1]}\n"));
    write_map("[0, 0, 0]", "\xfe\xfe\xfe\xcd\xfe\xfe");
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void write_map(const std::string& origin, const std::string& pixels) const {
    write_file(folder_ + "/base/maps/m.pgm", "P5 3 2 255\n" + pixels);
    write_file(folder_ + "/base/maps/m.yaml",
               "image: m.pgm\nresolution: 1\norigin: " + origin +
                   "\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n");
  }
  [[nodiscard]] Scenario load() const { return load_scenario(folder_ + "/line.yaml"); }

  // One per test: they may run at the same time.
  std::string folder_ = testing::TempDir() + "/map_of_an_extended_file_" +
                        testing::UnitTest::GetInstance()->current_test_info()->name();
};

TEST_F(MapOfAnExtendedFile, IsFoundBesideTheFileThatNamesIt) {
  const Scenario scenario = load();
  const OccupancyGrid& grid = *scenario.map->grid;
  EXPECT_EQ(grid.columns(), 3);
  EXPECT_EQ(grid.state({0, 0}),
            CellState::kOccupied);  // the box, over what is unknown in the image
  EXPECT_EQ(grid.count(CellState::kFree), 5U);
}

TEST_F(MapOfAnExtendedFile, ChangesTheHashWithItsImage) {
  const std::uint64_t before = load().content_hash;
  EXPECT_EQ(load().content_hash, before);
  write_map("[0, 0, 0]", "\xfe\xfe\xfe\xfe\xfe\xfe");
  EXPECT_NE(load().content_hash, before);
}

TEST_F(MapOfAnExtendedFile, MayBeTurnedWithinItsBounds) {
  write_map("[10, 20, 1.5707963267948966]", "\xfe\xfe\xfe\xfe\xfe\xfe");
  const Rectangle bounds = load().map->bounds;
  EXPECT_NEAR(bounds.x0_m, 8.0, 1e-9);
  EXPECT_NEAR(bounds.x1_m, 10.0, 1e-9);
  EXPECT_NEAR(bounds.y0_m, 20.0, 1e-9);
  EXPECT_NEAR(bounds.y1_m, 23.0, 1e-9);
}

TEST(LoadMap, AMapFileNeedsAFolder) {
  EXPECT_NE(error_of(small_line("map: {occupancy: m.yaml}\n"))
                .find("t.yaml:7:18: error: 'occupancy' needs a file"),
            std::string::npos);
}

TEST(LoadMap, ObstaclesThatWouldTakeTooLongToDrawAreRefused) {
  std::string obstacles;
  for (int i = 0; i < 100; ++i) obstacles += "    o" + std::to_string(i) + ": [0, 100, 0, 100]\n";
  EXPECT_NE(error_of(small_line("map:\n  bounds: [0, 100, 0, 100]\n  cell_m: 0.03\n"
                                "  obstacles:\n" +
                                obstacles))
                .find("the obstacles cover too many cells of the map"),
            std::string::npos);
}

TEST(LoadScenario, HashIgnoresCommentsAndLayoutOnly) {
  const auto hash = [](const std::string& text) {
    return load_scenario_text(text, "t").content_hash;
  };
  EXPECT_EQ(hash(small_line()), hash("# a comment\n" + small_line("\n\n")));
  EXPECT_NE(hash(small_line()), hash(small_line("", "4")));
}

TEST(LoadScenario, FloorAreasOfMachinesAreForPicturesOnly) {
  const auto load = [](const std::string& machines) {
    return load_scenario_text(small_line("machines: {" + machines + "}\n"), "t");
  };
  const Scenario plain = load("press: {}, saw: {}");
  const Scenario drawn =
      load("press: {area_m: [1, 3, 2, 4]}, saw: {area_m: {polygon: [[0, 0], [0, 1], [1, 0]]}}");
  EXPECT_EQ(plain.content_hash, drawn.content_hash);
  EXPECT_NE(plain.content_hash, load("press: {}, lathe: {}").content_hash);
  EXPECT_TRUE(plain.line.machines[0].area_m.empty());
  const auto& press = drawn.line.machines[0].area_m;
  ASSERT_EQ(press.size(), 4U);
  EXPECT_EQ(press[2].x_m, 3.0);
  EXPECT_EQ(press[2].y_m, 4.0);
  const auto& saw = drawn.line.machines[1].area_m;  // counter-clockwise, as all polygons
  ASSERT_EQ(saw.size(), 3U);
  EXPECT_GT(doubled_area_m2(saw), 0.0);
}

TEST(LoadScenario, FloorAreasMayDifferPerValueOfATemplate) {
  const Scenario scenario = load_scenario_text(
      small_line(
          "for: {s: [left, right]}\n"
          "machines: {press.$s: {area_m: [{left: 0, right: 5}, {left: 1, right: 6}, 0, 1]}}\n"),
      "t");
  EXPECT_EQ(scenario.line.machines[0].area_m[0].x_m, 0.0);
  EXPECT_EQ(scenario.line.machines[1].area_m[0].x_m, 5.0);
}

TEST(LoadScenario, ExtendsNeedsAFile) {
  EXPECT_NE(error_of(small_line("extends: other.yaml\n")).find("'extends' needs a file"),
            std::string::npos);
}

TEST(LoadScenario, NamesThatConditionsCouldMisreadAreRefused) {
  EXPECT_NE(error_of(small_line("machines: {press.free: {}}\n")).find("'.free' as an attribute"),
            std::string::npos);
  EXPECT_NE(error_of(small_line("machines: {order: {}}\n")).find("a meaning of its own"),
            std::string::npos);
  EXPECT_NE(error_of(small_line("machines: {9lives: {}}\n")).find("names start with a letter"),
            std::string::npos);
  EXPECT_NE(
      error_of(small_line("machines: {stock: {}}\n")).find("the name of a place and of a machine"),
      std::string::npos);
}

TEST(LoadScenario, NumbersOutsideOfTheirRangeAreRefused) {
  for (const char* number : {"-1", "1e9", ".nan", ".inf", "1.5", "010", "99999999999999999999",
                             "''", "'1'", "[1]", "{}", "~"}) {
    const std::string text = small_line(
        "machines: {m: {homing: {to: x, takes: {}, holds: " + std::string(number) + "}}}\n");
    EXPECT_NE(error_of(text).find("'homing.holds' must be a whole number from 0 to 100000000"),
              std::string::npos)
        << number << "\n"
        << error_of(text);
  }
  for (const char* number : {"nan", ".inf", "-1e999", "1e6", "0x10"}) {
    const std::string text = small_line("workers: {human: {}}\nstations: {s: {human: [0, " +
                                        std::string(number) + ", 0]}}\n");
    EXPECT_NE(error_of(text).find("station 's': 'human' must be a number from -100000 to 100000"),
              std::string::npos)
        << number;
  }
}

}  // namespace
}  // namespace linewright
