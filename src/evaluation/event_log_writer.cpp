#include "linewright/evaluation/event_log_writer.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "header_json.hpp"
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

/// Turns the numbers of a log into names.
class Writer {
 public:
  Writer(const Scenario& scenario, const EventLog& log, double progress,
         const std::vector<DecisionExplanation>& explanations)
      : line_(scenario.line),
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

  std::string text(std::size_t first) {
    for (std::size_t i = first; i < log_.events.size(); ++i) append(entry(log_.events[i]));
    return std::move(text_);
  }

 private:
  void append(const Json& object) {
    text_ += object.dump();
    text_ += '\n';
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
  return event_log_header(scenario, log.setup) +
         event_log_lines(scenario, log, 0, progress, explanations);
}

std::string event_log_header(const Scenario& scenario, const RunSetup& setup) {
  return event_log::header_json(scenario, setup).dump() + '\n';
}

std::string event_log_lines(const Scenario& scenario, const EventLog& log, std::size_t first,
                            double progress, const std::vector<DecisionExplanation>& explanations) {
  return Writer(scenario, log, progress, explanations).text(first);
}

}  // namespace linewright
