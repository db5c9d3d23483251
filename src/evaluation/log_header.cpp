#include "log_header.hpp"

#include <fmt/format.h>

#include <functional>
#include <utility>

#include "linewright/line/way_finder.hpp"

namespace linewright::event_log {
namespace {

// Far beyond what a scenario may have; bounds what a hostile file can cost.
constexpr double kTallestObstacle = 1e5;  // metres
constexpr double kLargest = 1e6;          // of a worker's measures
constexpr std::size_t kMostEntries = 30'000;
constexpr std::int64_t kLargestAmount = 1'000'000'000'000;
constexpr std::int64_t kLargestInt = INT32_MAX;

class HeaderReader {
 public:
  HeaderReader(const Json& line, const LogPosition& where, LogIndex& index)
      : fields_(line, "the header", where), where_(where), index_(index) {}

  LogHeader read() {
    check_format();
    read_run();
    read_stations();
    read_kinds();
    read_workers();
    read_carriers();
    read_places();
    read_machines();
    read_machine_sites();
    read_operations();
    read_tasks();
    read_order();
    read_zones();
    read_hall();
    return std::move(header_);
  }

 private:
  void check_format() const {
    if (fields_.find("format") == nullptr || !fields_.at("format").is_string()) {
      fail(where_, "is not an event log: the first line has no \"format\"",
           "write a log with: linewright simulate SCENARIO --log FILE");
    }
    const std::string& format = fields_.text("format");
    if (format != kFormat) {
      fail(
          where_,
          fmt::format("has the format {}, but this version reads '{}'", in_quotes(format), kFormat),
          "simulate the run again with this version, or read it with the version that wrote it");
    }
  }

  void read_run() {
    header_.line = fields_.text("line");
    header_.scenario_hash = fields_.text("scenario_hash");
    header_.tick_s = fields_.number("tick_s", 1e-9, 1e9);
    header_.horizon = static_cast<Tick>(fields_.integer("horizon", 0, kMaxTicks));
  }

  /// Calls `read` with every object of the list under `key`.
  void each(const char* key, const std::function<void(const LogFields&)>& read) const {
    const Json& list = fields_.list(key);
    if (list.size() > kMostEntries) {
      fields_.wrong(key, fmt::format("a list of at most {} entries", kMostEntries));
    }
    for (std::size_t i = 0; i < list.size(); ++i) {
      read(LogFields(list[i], fmt::format("{}[{}]", key, i), where_));
    }
  }

  void read_stations() {
    const LogFields stations = fields_.object("stations");
    for (const auto& [name, poses] : stations.json().items()) {
      LogStation station{name, {}};
      const LogFields by_kind(poses, fmt::format("station {}", in_quotes(name)), where_);
      for (const auto& [kind, pose] : by_kind.json().items()) {
        const auto numbers = numbers_of(pose, 3, by_kind.title(), where_);
        station.poses[kind] = {numbers[0], numbers[1], numbers[2]};
      }
      index_.stations.add(name, where_);
      header_.stations.push_back(std::move(station));
    }
  }

  void read_kinds() {
    if (fields_.find("kinds") == nullptr) return;
    const LogFields kinds = fields_.object("kinds");
    for (const auto& [name, value] : kinds.json().items()) {
      const LogFields entry(value, fmt::format("kind {}", in_quotes(name)), where_);
      LogKind kind{.name = name};
      if (entry.find("radius_m") != nullptr) kind.radius_m = entry.number("radius_m", 0, kLargest);
      if (entry.find("footprint_m") != nullptr) {
        kind.footprint_m =
            numbers_of(entry.at("footprint_m"), 2, "'footprint_m' of " + entry.title(), where_);
      }
      if (entry.find("outline_m") != nullptr) {
        kind.outline_m = polygon(entry.list("outline_m"), entry.title());
      }
      if (entry.find("speed_mps") != nullptr)
        kind.speed_mps = entry.number("speed_mps", 0, kLargest);
      header_.kinds.push_back(std::move(kind));
    }
  }

  void read_workers() {
    each("workers", [&](const LogFields& entry) {
      index_.workers.add(entry.text("id"), where_);
      header_.workers.push_back(
          {entry.text("id"), entry.text("kind"), entry.id<StationId>("start", index_.stations)});
    });
  }

  void read_carriers() {
    each("carriers", [&](const LogFields& entry) {
      index_.carriers.add(entry.text("id"), where_);
      header_.carriers.push_back(
          {entry.text("id"), entry.text("kind"),
           static_cast<std::int32_t>(entry.integer("capacity", 0, kLargestInt)),
           entry.id<StationId>("start", index_.stations)});
    });
  }

  void read_places() {
    each("places", [&](const LogFields& entry) {
      LogPlace place;
      place.name = entry.text("name");
      place.of = entry.text("of");
      place.initial = entry.integer("initial", 0, kLargestAmount);
      if (entry.find("capacity") != nullptr) {
        place.capacity = entry.integer("capacity", 0, kLargestAmount);
      }
      if (entry.find("berth") != nullptr) place.berth = entry.text("berth");
      if (entry.find("at") != nullptr) place.at = entry.id<StationId>("at", index_.stations);
      index_.places.add(place.name, where_);
      header_.places.push_back(std::move(place));
    });
  }

  void read_machines() {
    const Json& list = fields_.list("machines");
    if (list.size() > kMostEntries) fields_.wrong("machines", "a shorter list");
    for (const Json& name : list) {
      header_.machines.push_back(text_of(name, "'machines' of the header", where_));
      index_.machines.add(header_.machines.back(), where_);
    }
  }

  /// Calls `read` with every entry of the mapping from machines under `key`, which may be missing.
  void each_site(
      const char* key,
      const std::function<void(LogMachineSite&, const LogFields&, const std::string&)>& read) {
    if (fields_.find(key) == nullptr) return;
    const LogFields sites = fields_.object(key);
    for (const auto& [name, value] : sites.json().items()) {
      read(header_.machine_sites[index_.machines.at(name, where_)], sites, name);
    }
  }

  void read_machine_sites() {
    header_.machine_sites.resize(header_.machines.size());
    each_site("machine_stations",
              [&](LogMachineSite& site, const LogFields& of, const std::string& name) {
                site.at = of.id<StationId>(name.c_str(), index_.stations);
              });
    each_site("machine_positions",
              [&](LogMachineSite& site, const LogFields& of, const std::string& name) {
                for (const Json& position : of.list(name.c_str())) {
                  site.positions.push_back(text_of(position, of.title(), where_));
                }
              });
    each_site("machine_areas",
              [&](LogMachineSite& site, const LogFields& of, const std::string& name) {
                site.area_m = polygon(of.list(name.c_str()), "the area of " + in_quotes(name));
              });
  }

  std::vector<MachineId> machines(const LogFields& entry, const char* key) const {
    std::vector<MachineId> ids;
    if (entry.find(key) == nullptr) return ids;
    for (const Json& name : entry.list(key)) {
      ids.emplace_back(index_.machines.at(text_of(name, key, where_), where_));
    }
    return ids;
  }

  std::vector<LogTokens> tokens(const LogFields& entry, const char* key) const {
    std::vector<LogTokens> flows;
    if (entry.find(key) == nullptr) return flows;
    const LogFields counts = entry.object(key);
    for (const auto& [place, count] : counts.json().items()) {
      flows.push_back({PlaceId(index_.places.at(place, where_)),
                       counts.integer(place.c_str(), 0, kLargestAmount)});
    }
    return flows;
  }

  void read_operations() {
    const auto ticks = [](const LogFields& entry, const char* key) {
      return entry.find(key) == nullptr ? 0 : static_cast<Tick>(entry.integer(key, 0, kMaxTicks));
    };
    each("operations", [&](const LogFields& entry) {
      LogOperation operation;
      operation.name = entry.text("name");
      operation.takes = ticks(entry, "takes");
      operation.recovery = ticks(entry, "recovery");
      operation.uses = machines(entry, "uses");
      operation.claims = machines(entry, "claims");
      operation.frees = machines(entry, "frees");
      operation.consumes = tokens(entry, "consumes");
      operation.produces = tokens(entry, "produces");
      index_.operations.add(operation.name, where_);
      header_.operations.push_back(std::move(operation));
    });
  }

  void read_tasks() {
    each("tasks", [&](const LogFields& entry) {
      index_.tasks.add(entry.text("name"), where_);
      header_.tasks.push_back(
          {static_cast<std::int32_t>(entry.integer("number", 0, kLargestInt)), entry.text("name")});
    });
  }

  void read_order() {
    const LogFields order = fields_.object("order");
    header_.product = order.text("product");
    header_.quantity = order.integer("quantity", 0, kLargestAmount);
    header_.finished_in = order.id<PlaceId>("finished_in", index_.places);
  }

  void read_zones() {
    if (fields_.find("zones") == nullptr) return;
    if (fields_.list("zones").size() > kMostZones) {
      fields_.wrong("zones", fmt::format("a list of at most {} zones", kMostZones));
    }
    each("zones", [&](const LogFields& entry) {
      LogZone zone{entry.text("name"), polygon(entry.list("polygon"), entry.title()), {}};
      for (const Json& span : entry.list("closed")) zone.closed.push_back(span_of(span, entry));
      index_.zones.add(zone.name, where_);
      header_.zones.push_back(std::move(zone));
    });
  }

  /// [tick, ticks] as from and until.
  std::pair<Tick, Tick> span_of(const Json& span, const LogFields& zone) const {
    const auto whole = [](const Json& number) {
      return number.is_number_integer() && number.get<double>() >= 1 &&
             number.get<double>() <= 2.0 * kMaxTicks;
    };
    if (!span.is_array() || span.size() != 2 || !whole(span[0]) || !whole(span[1])) {
      zone.wrong("closed", "a list of [tick, ticks]");
    }
    return {span[0].get<Tick>(), span[0].get<Tick>() + span[1].get<Tick>()};
  }

  LogRectangle rectangle(const LogFields& fields, const char* key) const {
    const auto n =
        numbers_of(fields.at(key), 4, fmt::format("'{}' of {}", key, fields.title()), where_);
    return {n[0], n[1], n[2], n[3]};
  }

  std::vector<Point2> polygon(const Json& list, const std::string& of) const {
    std::vector<Point2> corners;
    for (const Json& corner : list) {
      const auto n = numbers_of(corner, 2, "a corner of " + of, where_);
      corners.push_back({n[0], n[1]});
    }
    if (corners.size() < 3) {
      fail(where_, fmt::format("{} has fewer than three corners", of), "give three at least");
    }
    return corners;
  }

  void read_hall() {
    if (fields_.find("hall") == nullptr) return;
    const LogFields hall = fields_.object("hall");
    LogHall& read = header_.hall.emplace();
    read.bounds = rectangle(hall, "bounds");
    for (const Json& entry : hall.list("obstacles")) {
      const LogFields obstacle(entry, "an obstacle of the hall", where_);
      read.obstacles.push_back({obstacle.text("name"),
                                polygon(obstacle.list("polygon"), obstacle.title()),
                                obstacle.number("height", 0.0, kTallestObstacle)});
    }
  }

  LogFields fields_;
  const LogPosition& where_;
  LogIndex& index_;
  LogHeader header_;
};

}  // namespace

LogHeader read_log_header(const Json& line, const LogPosition& where, LogIndex& index) {
  return HeaderReader(line, where, index).read();
}

}  // namespace linewright::event_log
