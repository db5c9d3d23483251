#include "log_events.hpp"

#include <fmt/format.h>

#include <map>
#include <utility>

#include "linewright/base/diagnostic.hpp"

namespace linewright::event_log {
namespace {

// A start, the travel of a machine and the operation itself may each last as long as a horizon.
constexpr Tick kLatestEnd = 4 * kMaxTicks;

/// What every event needs to be read.
struct Source {
  const LogFields& fields;
  const LogIndex& index;
  Tick tick = 0;

  [[nodiscard]] std::int32_t n() const {
    return static_cast<std::int32_t>(fields.integer("n", 1, INT32_MAX));
  }
  /// 0: none, of a worker without a task.
  [[nodiscard]] std::int32_t n_if_any() const { return fields.find("n") == nullptr ? 0 : n(); }
  [[nodiscard]] WorkerId worker() const { return fields.id<WorkerId>("worker", index.workers); }
  [[nodiscard]] CarrierId carrier() const {
    return fields.id<CarrierId>("carrier", index.carriers);
  }
  [[nodiscard]] TaskId task() const { return fields.id<TaskId>("task", index.tasks); }
  [[nodiscard]] StationId station(const char* key) const {
    return fields.id<StationId>(key, index.stations);
  }
  [[nodiscard]] OperationId operation() const {
    return fields.id<OperationId>("operation", index.operations);
  }
  [[nodiscard]] Tick tick_from(const char* key, Tick earliest) const {
    return static_cast<Tick>(fields.integer(key, earliest, kLatestEnd));
  }
};

void add_member(LoggedRole& role, const std::string& name, const Source& source) {
  if (const auto worker = source.index.workers.find(name)) {
    role.workers.emplace_back(*worker);
  } else if (const auto carrier = source.index.carriers.find(name)) {
    role.carriers.emplace_back(*carrier);
  } else {
    std::vector<std::string> known = source.index.workers.names();
    known.insert(known.end(), source.index.carriers.names().begin(),
                 source.index.carriers.names().end());
    fail(source.fields.where(), fmt::format("unknown worker or carrier {}", in_quotes(name)),
         name_hint(name, known));
  }
}

LoggedEvent::What read_decision(const Source& source) {
  LoggedDecision decision{source.n(), source.task(), {}};
  const LogFields crew = source.fields.object("crew");
  for (const auto& [name, members] : crew.json().items()) {
    LoggedRole role{name, {}, {}};
    for (const Json& member : crew.list(name.c_str())) {
      add_member(role, text_of(member, crew.title(), source.fields.where()), source);
    }
    decision.crew.push_back(std::move(role));
  }
  return decision;
}

LoggedEvent::What read_join(const Source& source) {
  return LoggedJoin{source.n(), source.worker(), source.fields.text("role")};
}

/// What a `go` and a `reroute` say about their way.
template <class Way>
Way read_way(const Source& source, Way way) {
  way.departs = source.tick_from("departs", source.tick);
  way.arrives = source.tick_from("arrives", way.departs);
  way.metres = source.fields.number("metres", 0.0, 1e9);
  if (source.fields.find("path") == nullptr) return way;
  for (const Json& point : source.fields.list("path")) {
    const auto numbers = numbers_of(point, 4, "a point of 'path'", source.fields.where());
    way.path.push_back({{numbers[0], numbers[1], numbers[2]}, numbers[3]});
  }
  return way;
}

Pose2 read_pose(const Source& source) {
  const auto n = numbers_of(source.fields.at("pose"), 3, "'pose' of " + source.fields.title(),
                            source.fields.where());
  return {n[0], n[1], n[2]};
}

LoggedEvent::What read_go(const Source& source) {
  return read_way(source, LoggedGo{source.n_if_any(),
                                   source.worker(),
                                   source.station("from"),
                                   source.station("to"),
                                   0,
                                   0,
                                   0.0,
                                   {}});
}

LoggedEvent::What read_reroute(const Source& source) {
  return read_way(source, LoggedReroute{source.n_if_any(),
                                        source.worker(),
                                        read_pose(source),
                                        source.station("to"),
                                        0,
                                        0,
                                        0.0,
                                        {}});
}

LoggedEvent::What read_blocked(const Source& source) {
  return LoggedBlocked{source.worker(), read_pose(source), source.station("to")};
}

LoggedEvent::What read_zone(const Source& source) {
  return LoggedZone{source.fields.id<ZoneId>("zone", source.index.zones),
                    source.fields.boolean("closed")};
}

LoggedEvent::What read_pick_up(const Source& source) {
  return LoggedPickUp{source.n(), source.worker(), source.carrier()};
}

LoggedEvent::What read_put_down(const Source& source) {
  LoggedPutDown down{source.n(), source.worker(), source.carrier(), source.station("station"), {}};
  if (source.fields.find("berth") != nullptr) {
    down.berth = source.fields.id<PlaceId>("berth", source.index.places);
  }
  return down;
}

LoggedEvent::What read_berth(const Source& source) {
  return LoggedBerth{source.n(), source.carrier(),
                     source.fields.id<PlaceId>("berth", source.index.places)};
}

LoggedTransfer::End transfer_end(const Source& source, const char* key) {
  const std::string& name = source.fields.text(key);
  if (const auto place = source.index.places.find(name)) return PlaceId(*place);
  if (const auto carrier = source.index.carriers.find(name)) return CarrierId(*carrier);
  return PlaceId(source.index.places.at(name, source.fields.where()));  // says what is known
}

LoggedEvent::What read_transfer(const Source& source) {
  return LoggedTransfer{source.n(), source.worker(), transfer_end(source, "from"),
                        transfer_end(source, "to"), source.tick_from("until", source.tick)};
}

LoggedEvent::What read_operation_start(const Source& source) {
  LoggedOperationStart start{source.operation(), source.tick_from("until", source.tick), {}};
  if (source.fields.find("worker") != nullptr) start.worker = source.worker();
  return start;
}

LoggedEvent::What read_operation_end(const Source& source) {
  return LoggedOperationEnd{source.operation()};
}

LoggedEvent::What read_recovery_end(const Source& source) {
  return LoggedRecoveryEnd{source.operation()};
}

LoggedEvent::What read_release(const Source& source) {
  return LoggedRelease{source.n(), source.worker()};
}

LoggedEvent::What read_task_end(const Source& source) {
  return LoggedTaskEnd{source.n(), source.task()};
}

LoggedEvent::What read_milestone(const Source& source) {
  return LoggedMilestone{source.fields.text("name")};
}

LoggedEnd read_end(const LogFields& fields, Tick tick) {
  LoggedEnd end{tick, RunStatus::kFinished, {}, fields.number("progress", 0.0, 1.0)};
  const std::string& status = fields.text("status");
  if (status == "finished") {
    end.makespan = static_cast<Tick>(fields.integer("makespan", 0, kMaxTicks));
    return end;
  }
  if (status == "deadlock") {
    end.status = RunStatus::kDeadlock;
  } else if (status == "horizon") {
    end.status = RunStatus::kHorizon;
  } else {
    fields.wrong("status", "'finished', 'deadlock' or 'horizon'");
  }
  if (!fields.at("makespan").is_null())
    fields.wrong("makespan", "null in a run that did not finish");
  return end;
}

using ReadEvent = LoggedEvent::What (*)(const Source&);

const std::map<std::string, ReadEvent>& readers() {
  static const std::map<std::string, ReadEvent> kReaders = {
      {"decision", read_decision},
      {"join", read_join},
      {"go", read_go},
      {"reroute", read_reroute},
      {"blocked", read_blocked},
      {"zone", read_zone},
      {"pick_up", read_pick_up},
      {"put_down", read_put_down},
      {"berth", read_berth},
      {"transfer", read_transfer},
      {"operation_start", read_operation_start},
      {"operation_end", read_operation_end},
      {"recovery_end", read_recovery_end},
      {"release", read_release},
      {"task_end", read_task_end},
      {"milestone", read_milestone},
  };
  return kReaders;
}

[[noreturn]] void unknown_event(const std::string& name, const LogPosition& where) {
  std::vector<std::string> known{"end"};
  for (const auto& [event, reader] : readers()) known.push_back(event);
  fail(where, fmt::format("unknown event {}", in_quotes(name)), name_hint(name, known));
}

}  // namespace

LogLine read_log_line(const Json& line, const LogPosition& where, const LogIndex& index) {
  const std::string name = LogFields(line, "an event", where).text("event");
  const LogFields fields(line, fmt::format("event {}", in_quotes(name)), where);
  const auto tick = static_cast<Tick>(fields.integer("t", 0, kMaxTicks));
  if (name == "end") return read_end(fields, tick);
  const auto reader = readers().find(name);
  if (reader == readers().end()) unknown_event(name, where);
  return LoggedEvent{tick, reader->second(Source{fields, index, tick})};
}

std::optional<std::int32_t> decision_number(const LoggedEvent& event) {
  return std::visit(
      [](const auto& what) -> std::optional<std::int32_t> {
        if constexpr (requires { what.n; }) {
          return what.n;
        } else {
          return std::nullopt;
        }
      },
      event.what);
}

}  // namespace linewright::event_log
