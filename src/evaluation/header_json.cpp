#include "header_json.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <utility>
#include <vector>

#include "linewright/evaluation/event_log_writer.hpp"
#include "log_ways.hpp"

namespace linewright::event_log {
namespace {

using Json = nlohmann::ordered_json;

Json order(const LineModel& line, const RunSetup& setup) {
  return {{"product", line.order.product},
          {"quantity", setup.order},
          {"finished_in", line.places[line.order.finished_in.index()].name}};
}

Json worker_list(const LineModel& line, const RunSetup& setup) {
  Json list = Json::array();
  const std::vector<std::string> names = worker_names(line, setup);
  for (std::size_t k = 0; k < setup.worker_start.size(); ++k) {
    for (const StationId start : setup.worker_start[k]) {
      list.push_back({{"id", names[list.size()]},
                      {"kind", line.worker_kinds[k].name},
                      {"start", line.stations[start.index()].name}});
    }
  }
  return list;
}

Json carrier_list(const LineModel& line, const RunSetup& setup) {
  Json list = Json::array();
  const std::vector<std::string> names = carrier_names(line, setup);
  for (std::size_t k = 0; k < setup.carrier_start.size(); ++k) {
    for (const StationId start : setup.carrier_start[k]) {
      list.push_back({{"id", names[list.size()]},
                      {"kind", line.carrier_kinds[k].name},
                      {"capacity", line.carrier_kinds[k].capacity},
                      {"start", line.stations[start.index()].name}});
    }
  }
  return list;
}

Json corners(const std::vector<Point2>& polygon) {
  Json list = Json::array();
  for (const Point2 corner : polygon) list.push_back({corner.x_m, corner.y_m});
  return list;
}

/// How large and how fast the workers of each kind are.
Json kind_table(const LineModel& line) {
  Json table = Json::object();
  for (const WorkerKind& kind : line.worker_kinds) {
    Json entry = Json::object();
    if (!kind.footprint_m.empty()) {
      entry["footprint_m"] = kind.footprint_m;
    } else if (!kind.outline_m.empty()) {
      entry["outline_m"] = corners(kind.outline_m);
    } else {
      entry["radius_m"] = kind.radius_m;
    }
    entry["speed_mps"] = kind.speed_mps;
    table[kind.name] = std::move(entry);
  }
  return table;
}

Json station_table(const LineModel& line) {
  Json table = Json::object();
  for (const Station& station : line.stations) {
    Json poses = Json::object();
    for (std::size_t k = 0; k < line.worker_kinds.size(); ++k) {
      if (const auto& pose = station.poses[k]) {
        poses[line.worker_kinds[k].name] = {pose->x_m, pose->y_m, pose->heading_rad};
      }
    }
    table[station.name] = std::move(poses);
  }
  return table;
}

Json place_list(const LineModel& line, std::int32_t order) {
  Json list = Json::array();
  for (const Place& place : line.places) {
    Json entry{{"name", place.name},
               {"of", place.of.empty() ? place.name : place.of},
               {"initial", place.initial.value(order)}};
    if (place.capacity) entry["capacity"] = *place.capacity;
    if (place.at) entry["at"] = line.stations[place.at->index()].name;
    if (place.berth) entry["berth"] = line.carrier_kinds[place.berth->carrier.index()].name;
    list.push_back(std::move(entry));
  }
  return list;
}

Json operation_list(const LineModel& line) {
  Json list = Json::array();
  for (const Operation& operation : line.operations) {
    Json entry{{"name", operation.name}, {"takes", operation.takes}};
    if (operation.recovery > 0) entry["recovery"] = operation.recovery;
    const auto machines = [&](const char* key, const std::vector<MachineUse>& uses) {
      for (const MachineUse& use : uses)
        entry[key].push_back(line.machines[use.machine.index()].name);
    };
    const auto tokens = [&](const char* key, const std::vector<TokenFlow>& flows) {
      for (const TokenFlow& flow : flows)
        entry[key][line.places[flow.place.index()].name] = flow.count;
    };
    machines("uses", operation.uses);
    machines("claims", operation.claims);
    machines("frees", operation.frees);
    tokens("consumes", operation.consumes);
    tokens("produces", operation.produces);
    list.push_back(std::move(entry));
  }
  return list;
}

Json hall(const HallMap& map) {
  Json obstacles = Json::array();
  for (const Obstacle& obstacle : map.obstacles) {
    obstacles.push_back({{"name", obstacle.name},
                         {"polygon", corners(obstacle.polygon)},
                         {"height", obstacle.height_m}});
  }
  const Rectangle& bounds = map.bounds;
  return {{"bounds", {bounds.x0_m, bounds.x1_m, bounds.y0_m, bounds.y1_m}},
          {"obstacles", std::move(obstacles)}};
}

/// Where the machines are and how they look: each key only for the machines that have it.
void write_machines(Json& head, const LineModel& line) {
  Json stations = Json::object();
  Json positions = Json::object();
  Json areas = Json::object();
  head["machines"] = Json::array();
  for (const Machine& machine : line.machines) {
    head["machines"].push_back(machine.name);
    if (machine.at) stations[machine.name] = line.stations[machine.at->index()].name;
    if (!machine.positions.empty()) positions[machine.name] = machine.positions;
    if (!machine.area_m.empty()) areas[machine.name] = corners(machine.area_m);
  }
  head["machine_stations"] = std::move(stations);
  head["machine_positions"] = std::move(positions);
  head["machine_areas"] = std::move(areas);
}

}  // namespace

Json header_json(const Scenario& scenario, const RunSetup& setup) {
  const LineModel& line = scenario.line;
  Json head{{"format", "linewright/event_log/1"},
            {"line", line.name},
            {"scenario_hash", fmt::format("{:016x}", scenario.content_hash)},
            {"tick_s", line.tick_s},
            {"horizon", setup.horizon},
            {"order", order(line, setup)},
            {"kinds", kind_table(line)},
            {"workers", worker_list(line, setup)},
            {"carriers", carrier_list(line, setup)},
            {"stations", station_table(line)},
            {"places", place_list(line, setup.order)}};
  write_machines(head, line);
  head["operations"] = operation_list(line);
  head["tasks"] = Json::array();
  for (const Task& task : line.tasks) {
    head["tasks"].push_back({{"number", task.number}, {"name", task.name}});
  }
  if (!line.zones.empty()) head["zones"] = zone_list(line, setup);
  if (scenario.map) head["hall"] = hall(*scenario.map);
  return head;
}

}  // namespace linewright::event_log
