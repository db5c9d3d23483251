#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "common.hpp"
#include "linewright/base/diagnostic.hpp"
#include "linewright/base/files.hpp"
#include "linewright/map/map_file.hpp"

namespace linewright::cli {
namespace {

using Json = nlohmann::ordered_json;

struct MapArguments {
  std::string scenario;
  std::string out;
  bool json = false;
};

/// Where one kind of worker stands at a station, and what the cell there is.
struct Stop {
  std::string station;
  std::string kind;
  Pose2 pose;
  std::string cell;  ///< "free", "occupied", "unknown" or "outside"
};

const char* name_of(CellState state) {
  switch (state) {
    case CellState::kFree:
      return "free";
    case CellState::kOccupied:
      return "occupied";
    case CellState::kUnknown:
      break;
  }
  return "unknown";
}

std::vector<Stop> stops_of(const LineModel& line, const OccupancyGrid& grid) {
  std::vector<Stop> stops;
  for (const Station& station : line.stations) {
    for (std::size_t k = 0; k < line.worker_kinds.size(); ++k) {
      const auto& pose = station.poses[k];
      if (!pose) continue;
      const Cell cell = grid.frame().cell_at(pose->point());
      stops.push_back({station.name, line.worker_kinds[k].name, *pose,
                       grid.frame().contains(cell) ? name_of(grid.state(cell)) : "outside"});
    }
  }
  return stops;
}

Json json_of(const LineModel& line, const HallMap& map, const std::vector<Stop>& stops) {
  const OccupancyGrid& grid = *map.grid;
  const Pose2& origin = grid.frame().origin;
  Json object{{"line", line.name},
              {"columns", grid.columns()},
              {"rows", grid.rows()},
              {"cell_m", grid.cell_m()},
              {"origin", {origin.x_m, origin.y_m, origin.heading_rad}},
              {"bounds", {map.bounds.x0_m, map.bounds.x1_m, map.bounds.y0_m, map.bounds.y1_m}},
              {"occupancy", map.occupancy.empty() ? Json(nullptr) : Json(map.occupancy)},
              {"cells", Json::object()},
              {"obstacles", Json::array()},
              {"stations", Json::array()}};
  for (const CellState state : {CellState::kFree, CellState::kOccupied, CellState::kUnknown}) {
    object["cells"][name_of(state)] = grid.count(state);
  }
  for (const Obstacle& obstacle : map.obstacles) {
    object["obstacles"].push_back({{"name", obstacle.name},
                                   {"corners", obstacle.polygon.size()},
                                   {"area_m2", 0.5 * doubled_area_m2(obstacle.polygon)},
                                   {"height_m", obstacle.height_m}});
  }
  for (const Stop& stop : stops) {
    object["stations"].push_back({{"station", stop.station},
                                  {"kind", stop.kind},
                                  {"pose", {stop.pose.x_m, stop.pose.y_m, stop.pose.heading_rad}},
                                  {"cell", stop.cell},
                                  {"blocked", stop.cell != "free"}});
  }
  return object;
}

std::string facts_text(const LineModel& line, const HallMap& map) {
  const OccupancyGrid& grid = *map.grid;
  const Pose2& origin = grid.frame().origin;
  std::string text = fmt::format(
      "{}: {} x {} cells of {} m: {:.6g} m x {:.6g} m, {}\n", line.name, grid.columns(),
      grid.rows(), grid.cell_m(), grid.columns() * grid.cell_m(), grid.rows() * grid.cell_m(),
      map.occupancy.empty() ? "bounds and obstacles of the scenario" : "from " + map.occupancy);
  text += fmt::format("lower left corner at {:.6g}, {:.6g}, turned by {:.6g} rad\n", origin.x_m,
                      origin.y_m, origin.heading_rad);
  for (const CellState state : {CellState::kFree, CellState::kOccupied, CellState::kUnknown}) {
    const std::size_t count = grid.count(state);
    text += fmt::format("{:8} {:9} cells {:5.1f} %\n", name_of(state), count,
                        100.0 * static_cast<double>(count) / static_cast<double>(grid.size()));
  }
  return text;
}

std::string lists_text(const HallMap& map, const std::vector<Stop>& stops) {
  std::vector<std::vector<std::string>> obstacles{{"obstacle", "corners", "m2", "height m"}};
  for (const Obstacle& o : map.obstacles) {
    obstacles.push_back({o.name, std::to_string(o.polygon.size()),
                         fmt::format("{:.2f}", 0.5 * doubled_area_m2(o.polygon)),
                         fmt::format("{:.2f}", o.height_m)});
  }
  std::vector<std::vector<std::string>> stations{{"station", "worker", "x m", "y m", "cell"}};
  for (const Stop& stop : stops) {
    stations.push_back({stop.station, stop.kind, fmt::format("{:.2f}", stop.pose.x_m),
                        fmt::format("{:.2f}", stop.pose.y_m),
                        stop.cell == "free" ? "free" : stop.cell + ", blocked"});
  }
  std::string text;
  if (obstacles.size() > 1) text += "\n" + text_table(obstacles);
  if (stations.size() > 1) text += "\n" + text_table(stations);
  return text;
}

/// A map file instead of a scenario would give a page of missing keys.
Scenario load_with_map(const std::string& file) {
  try {
    return load(file);
  } catch (const ScenarioError&) {
    constexpr std::size_t kMostBytes = std::size_t{1} << 20;
    std::string ignored;
    const auto text = read_file(file, kMostBytes, ignored);
    if (!text || !looks_like_map_file(*text)) throw;
  }
  throw ScenarioError(file, "this is a map file of ROS map_server, not a scenario",
                      "name it in a scenario, as map: {occupancy: FILE.yaml}, and give that");
}

int show(const MapArguments& arguments) {
  const Scenario scenario = load_with_map(arguments.scenario);
  if (!scenario.map) {
    throw ScenarioError(arguments.scenario, "the scenario has no map",
                        "write map: {bounds: [x0, x1, y0, y1]}, or map: {occupancy: FILE.yaml}");
  }
  const HallMap& map = *scenario.map;
  if (!arguments.out.empty()) save_map_file(*map.grid, arguments.out);
  const std::vector<Stop> stops = stops_of(scenario.line, *map.grid);
  if (arguments.json) {
    Json object = json_of(scenario.line, map, stops);
    if (!arguments.out.empty()) object["out"] = arguments.out;
    print(object.dump(2) + "\n");
    return kOk;
  }
  std::string text = facts_text(scenario.line, map) + lists_text(map, stops);
  if (!arguments.out.empty()) text += "\nmap file  " + arguments.out + "\n";
  print(text);
  return kOk;
}

}  // namespace

Command add_map(CLI::App& app) {
  auto arguments = std::make_shared<MapArguments>();
  app.add_option("scenario", arguments->scenario, "Scenario file (docs/formats/scenario.md)")
      ->required()
      ->type_name("SCENARIO");
  app.add_option("-o,--out", arguments->out,
                 "Write the map as ROS map_server reads it: this file, and a .pgm image beside it")
      ->type_name("FILE.yaml");
  app.add_flag("--json", arguments->json, "Print one JSON object (docs/cli.md) instead of text");
  app.footer("Example:\n  linewright map scenarios/duct_line.yaml --out out/hall.yaml");
  return [arguments] { return show(*arguments); };
}

}  // namespace linewright::cli
