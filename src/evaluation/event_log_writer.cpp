#include "linewright/evaluation/event_log_writer.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <system_error>

#include "linewright/base/diagnostic.hpp"
#include "log_explanations.hpp"
#include "log_ways.hpp"

namespace linewright {
namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string> numbered(const std::vector<std::string>& kinds,
                                  const std::vector<std::vector<StationId>>& start) {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < start.size(); ++k) {
    for (std::size_t i = 0; i < start[k].size(); ++i)
      names.push_back(fmt::format("{}.{}", kinds[k], i));
  }
  return names;
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
    Json polygon = Json::array();
    for (const Point2 corner : obstacle.polygon) polygon.push_back({corner.x_m, corner.y_m});
    obstacles.push_back(
        {{"name", obstacle.name}, {"polygon", std::move(polygon)}, {"height", obstacle.height_m}});
  }
  const Rectangle& bounds = map.bounds;
  return {{"bounds", {bounds.x0_m, bounds.x1_m, bounds.y0_m, bounds.y1_m}},
          {"obstacles", std::move(obstacles)}};
}

/// Turns the numbers of a log into names.
class Writer {
 public:
  Writer(const Scenario& scenario, const EventLog& log, double progress,
         const std::vector<DecisionExplanation>& explanations)
      : scenario_(scenario),
        line_(scenario.line),
        log_(log),
        progress_(progress),
        workers_(worker_names(line_, log.setup)),
        carriers_(carrier_names(line_, log.setup)) {
    for (std::size_t k = 0; k < log.setup.worker_start.size(); ++k) {
      worker_kind_.insert(worker_kind_.end(), log.setup.worker_start[k].size(), k);
    }
    for (const DecisionExplanation& explanation : explanations) {
      if (explanation.assignment) explanations_.push_back(&explanation);
    }
  }

  std::string text() {
    append(header());
    for (const LogEvent& event : log_.events) append(entry(event));
    return std::move(text_);
  }

 private:
  void append(const Json& object) {
    text_ += object.dump();
    text_ += '\n';
  }

  Json header() const {
    const RunSetup& setup = log_.setup;
    Json head{{"format", "linewright/event_log/1"},
              {"line", line_.name},
              {"scenario_hash", fmt::format("{:016x}", scenario_.content_hash)},
              {"tick_s", line_.tick_s},
              {"horizon", setup.horizon},
              {"order",
               {{"product", line_.order.product},
                {"quantity", setup.order},
                {"finished_in", line_.places[line_.order.finished_in.index()].name}}}};
    head["workers"] = Json::array();
    std::size_t id = 0;
    for (std::size_t k = 0; k < setup.worker_start.size(); ++k) {
      for (const StationId start : setup.worker_start[k]) {
        head["workers"].push_back({{"id", workers_[id++]},
                                   {"kind", line_.worker_kinds[k].name},
                                   {"start", line_.stations[start.index()].name}});
      }
    }
    head["carriers"] = Json::array();
    id = 0;
    for (std::size_t k = 0; k < setup.carrier_start.size(); ++k) {
      for (const StationId start : setup.carrier_start[k]) {
        head["carriers"].push_back({{"id", carriers_[id++]},
                                    {"kind", line_.carrier_kinds[k].name},
                                    {"capacity", line_.carrier_kinds[k].capacity},
                                    {"start", line_.stations[start.index()].name}});
      }
    }
    head["stations"] = station_table(line_);
    head["places"] = place_list(line_, setup.order);
    head["machines"] = Json::array();
    for (const Machine& machine : line_.machines) head["machines"].push_back(machine.name);
    head["operations"] = operation_list(line_);
    head["tasks"] = Json::array();
    for (const Task& task : line_.tasks) {
      head["tasks"].push_back({{"number", task.number}, {"name", task.name}});
    }
    if (!line_.zones.empty()) head["zones"] = event_log::zone_list(line_, setup);
    if (scenario_.map) head["hall"] = hall(*scenario_.map);
    return head;
  }

  Json entry(const LogEvent& event) const {
    Json out{{"t", event.tick}};
    switch (event.type) {
      case LogEvent::Type::kDecision:
        decision(out, event);
        break;
      case LogEvent::Type::kJoin:
        named(out, "join", event);
        out["role"] = role_of(event.b, static_cast<std::size_t>(event.c));
        break;
      case LogEvent::Type::kTaskEnd:
        out["event"] = "task_end";
        out["n"] = event.b;
        out["task"] = task_name(event.a);
        break;
      case LogEvent::Type::kRelease:
        named(out, "release", event);
        break;
      case LogEvent::Type::kGo:
        go(out, event);
        break;
      case LogEvent::Type::kReroute:
        named(out, "reroute", event);
        out["pose"] = event_log::pose_json(event.course.origin);
        out["to"] = line_.stations[index(event.d)].name;
        event_log::write_way(out, line_, event, kind_of(event.a));
        break;
      case LogEvent::Type::kBlocked:
        out["event"] = "blocked";
        out["worker"] = workers_[index(event.a)];
        out["pose"] = event_log::pose_json(event.course.origin);
        out["to"] = line_.stations[index(event.d)].name;
        break;
      case LogEvent::Type::kZone:
        out["event"] = "zone";
        out["zone"] = line_.zones[index(event.a)].name;
        out["closed"] = event.b == 1;
        break;
      case LogEvent::Type::kPickUp:
        named(out, "pick_up", event);
        out["carrier"] = carriers_[index(event.c)];
        break;
      case LogEvent::Type::kPutDown:
        named(out, "put_down", event);
        out["carrier"] = carriers_[index(event.c)];
        out["station"] = line_.stations[index(event.e)].name;
        if (event.d >= 0) out["berth"] = line_.places[index(event.d)].name;
        break;
      case LogEvent::Type::kBerth:
        out["event"] = "berth";
        out["n"] = event.b;
        out["carrier"] = carriers_[index(event.a)];
        out["berth"] = line_.places[index(event.c)].name;
        break;
      case LogEvent::Type::kTransfer:
        named(out, "transfer", event);
        out["from"] = endpoint(event.c);
        out["to"] = endpoint(event.d);
        out["until"] = event.until;
        break;
      case LogEvent::Type::kOperationStart:
        out["event"] = "operation_start";
        out["operation"] = line_.operations[index(event.a)].name;
        out["until"] = event.until;
        if (event.b >= 0) out["worker"] = workers_[index(event.b)];
        break;
      case LogEvent::Type::kOperationEnd:
        out["event"] = "operation_end";
        out["operation"] = line_.operations[index(event.a)].name;
        break;
      case LogEvent::Type::kRecoveryEnd:
        out["event"] = "recovery_end";
        out["operation"] = line_.operations[index(event.a)].name;
        break;
      case LogEvent::Type::kMilestone:
        out["event"] = "milestone";
        out["name"] = line_.milestones[index(event.a)].name;
        break;
      case LogEvent::Type::kEnd: {
        const auto status = static_cast<RunStatus>(event.a);
        out["event"] = "end";
        out["status"] = run_status_name(status);
        out["makespan"] = status == RunStatus::kFinished ? Json(event.tick) : Json(nullptr);
        out["progress"] = progress_;
        break;
      }
    }
    return out;
  }

  void named(Json& out, const char* name, const LogEvent& event) const {
    out["event"] = name;
    if (event.b >= 0) out["n"] = event.b;  // -1: on its way to rest, in no task
    out["worker"] = workers_[index(event.a)];
  }

  void decision(Json& out, const LogEvent& event) const {
    out["event"] = "decision";
    out["n"] = event.b;
    out["task"] = task_name(event.a);
    out["crew"] = Json::object();
    const auto& crew = line_.tasks[index(event.a)].crew;
    for (std::size_t slot = 0; slot < crew.size(); ++slot) {
      Json& role = out["crew"][crew[slot].role];
      if (role.is_null()) role = Json::array();
      if (event.members[slot] < 0) continue;
      const auto member = static_cast<std::size_t>(event.members[slot]);
      role.push_back(crew[slot].worker ? workers_[member] : carriers_[member]);
    }
    const std::size_t number = index(event.b - 1);
    if (number < explanations_.size()) {
      out["why"] = event_log::explanation_json(line_, workers_, *explanations_[number]);
    }
  }

  void go(Json& out, const LogEvent& event) const {
    named(out, "go", event);
    out["from"] = line_.stations[index(event.c)].name;
    out["to"] = line_.stations[index(event.d)].name;
    event_log::write_way(out, line_, event, kind_of(event.a));
  }

  std::string endpoint(std::int32_t code) const {
    return code >= 0 ? line_.places[index(code)].name : carriers_[index(-1 - code)];
  }

  std::string role_of(std::int32_t serial, std::size_t slot) const {
    for (const LogEvent& event : log_.events) {
      if (event.type == LogEvent::Type::kDecision && event.b == serial) {
        return line_.tasks[index(event.a)].crew[slot].role;
      }
    }
    return {};
  }

  const std::string& task_name(std::int32_t id) const { return line_.tasks[index(id)].name; }
  [[nodiscard]] WorkerKindId kind_of(std::int32_t worker) const {
    return WorkerKindId(worker_kind_[index(worker)]);
  }
  static std::size_t index(std::int32_t id) { return static_cast<std::size_t>(id); }

  const Scenario& scenario_;
  const LineModel& line_;
  const EventLog& log_;
  double progress_;
  std::vector<std::string> workers_;
  std::vector<std::string> carriers_;
  std::vector<std::size_t> worker_kind_;
  std::vector<const DecisionExplanation*> explanations_;  ///< by decision, or empty
  std::string text_;
};

}  // namespace

const char* run_status_name(RunStatus status) {
  switch (status) {
    case RunStatus::kFinished:
      return "finished";
    case RunStatus::kDeadlock:
      return "deadlock";
    case RunStatus::kHorizon:
      return "horizon";
    case RunStatus::kDecision:
    case RunStatus::kJoin:
    case RunStatus::kRunning:
      return "running";
  }
  return "running";
}

std::vector<std::string> worker_names(const LineModel& line, const RunSetup& setup) {
  std::vector<std::string> kinds;
  for (const WorkerKind& kind : line.worker_kinds) kinds.push_back(kind.name);
  return numbered(kinds, setup.worker_start);
}

std::vector<std::string> carrier_names(const LineModel& line, const RunSetup& setup) {
  std::vector<std::string> kinds;
  for (const CarrierKind& kind : line.carrier_kinds) kinds.push_back(kind.name);
  return numbered(kinds, setup.carrier_start);
}

std::string event_log_text(const Scenario& scenario, const EventLog& log, double progress,
                           const std::vector<DecisionExplanation>& explanations) {
  return Writer(scenario, log, progress, explanations).text();
}

}  // namespace linewright
