#include "linewright/evaluation/recorded_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>

#include "linewright/base/diagnostic.hpp"

namespace linewright {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kMostOfAKind = 10'000;  // what scenarios allow

/// Reads a record, collecting everything that is wrong with it.
class Reader {
 public:
  Reader(const std::string& file, const LineModel& line) : line_(line) { run_.file = file; }

  RecordedRun read(const std::string& text) {
    const Json first = parse(text.substr(0, text.find('\n')));
    const bool is_log = first.is_object() && first.contains("format");
    if (is_log) {
      read_log(text);
    } else {
      read_record(parse(text));
    }
    if (!problems_.empty()) throw ScenarioError(std::move(problems_));
    return std::move(run_);
  }

 private:
  /// Discarded when it is no JSON, or nested deeper than any record (printing it could exhaust the
  /// stack).
  static Json parse(const std::string& text) {
    constexpr int kDeepest = 32;
    bool too_deep = false;
    const auto watch = [&](int depth, Json::parse_event_t, Json&) {
      too_deep = too_deep || depth > kDeepest;
      return !too_deep;
    };
    Json parsed = Json::parse(text, watch, false);
    return too_deep ? Json(Json::value_t::discarded) : parsed;
  }

  void problem(std::string message, std::string hint, int line = 0) {
    problems_.push_back({.severity = Diagnostic::Severity::kError,
                         .file = run_.file,
                         .line = line,
                         .column = 0,
                         .message = std::move(message),
                         .hint = std::move(hint)});
  }

  void read_record(const Json& record) {
    if (!record.is_object()) {
      problem("is neither a JSON record of decisions nor an event log",
              "see docs/formats/decisions.md; a record is {\"crew\": ..., \"start\": ..., "
              "\"decisions\": [...]}");
      return;
    }
    run_.setup.order = integer(record, "order", 1, 1'000'000).value_or(line_.order.quantity);
    run_.setup.horizon = line_.horizon.ticks(run_.setup.order);
    read_start(record);
    read_closures(record);
    if (!record.contains("decisions") || !record["decisions"].is_array()) {
      problem("has no list 'decisions'",
              "write \"decisions\": [{\"tick\": 1, \"task\": ...}, ...]");
    } else {
      std::size_t number = 0;
      for (const Json& decision : record["decisions"]) read_decision(decision, ++number);
    }
    // A record may have had another limit: never cut it off before its own end.
    if (!run_.decisions.empty()) {
      const Tick last = run_.decisions.back().tick;
      run_.setup.horizon =
          std::max(run_.setup.horizon, last > kMaxTicks / 2 ? kMaxTicks : last * 2);
    }
    read_milestones(record);
    if (record.contains("finished") && record["finished"].is_boolean()) {
      run_.finished = record["finished"].get<bool>();
    }
    if (record.contains("makespan") && !record["makespan"].is_null()) {
      run_.makespan = integer(record, "makespan", 1, kMaxTicks);
    }
  }

  std::optional<std::int32_t> integer(const Json& object, const char* key, std::int64_t low,
                                      std::int64_t high) {
    if (!object.contains(key)) return std::nullopt;
    const Json& value = object[key];
    if (value.is_number_integer()) {
      const auto number = value.get<std::int64_t>();
      if (number >= low && number <= high) return static_cast<std::int32_t>(number);
    }
    problem(fmt::format("'{}' is {}", key, shorten(value)),
            fmt::format("write a whole number from {} to {}", low, high));
    return std::nullopt;
  }

  static std::string shorten(const Json& value) {
    const std::string text = value.dump(-1, ' ', true, Json::error_handler_t::replace);
    return text.size() > 60 ? text.substr(0, 57) + "..." : text;
  }

  std::vector<StationId> stations(const Json& start, const std::string& kind, std::size_t mover) {
    std::vector<StationId> list;
    const std::string key = start.contains(kind + "s") ? kind + "s" : kind;
    if (!start.contains(key) || !start[key].is_array()) {
      problem(fmt::format("'start' has no list '{}s'", kind),
              fmt::format("write \"start\": {{\"{}s\": [station, ...]}}", kind));
      return list;
    }
    std::vector<std::string> names;
    for (const Station& station : line_.stations) {
      if (station.poses[mover]) names.push_back(station.name);
    }
    for (const Json& entry : start[key]) {
      const std::string name = entry.is_string() ? entry.get<std::string>() : shorten(entry);
      std::optional<StationId> found;
      for (std::size_t s = 0; s < line_.stations.size(); ++s) {
        if (line_.stations[s].name == name && line_.stations[s].poses[mover]) found = StationId(s);
      }
      if (found) {
        list.push_back(*found);
      } else {
        problem(fmt::format("start.{}: no station '{}' for a {}", key, name, kind),
                name_hint(name, names));
      }
    }
    return list;
  }

  void read_start(const Json& record) {
    if (!record.contains("start") || !record["start"].is_object()) {
      problem("has no object 'start'", "write \"start\": {\"humans\": [station, ...], ...}");
      return;
    }
    const Json& start = record["start"];
    for (std::size_t k = 0; k < line_.worker_kinds.size(); ++k) {
      const WorkerKind& kind = line_.worker_kinds[k];
      run_.setup.worker_start.push_back(stations(start, kind.name, k));
      const std::size_t count = run_.setup.worker_start.back().size();
      if (problems_.empty() && (count < 1 || count > kMostOfAKind)) {
        problem(fmt::format("start: {} {}s", count, kind.name),
                fmt::format("give 1 to {} of them", kMostOfAKind));
      }
    }
    for (const CarrierKind& kind : line_.carrier_kinds) {
      run_.setup.carrier_start.push_back(stations(start, kind.name, kind.moved_by.index()));
      if (run_.setup.carrier_start.back().size() > kMostOfAKind) {
        problem(fmt::format("start: {} {}s", run_.setup.carrier_start.back().size(), kind.name),
                fmt::format("give at most {} of them", kMostOfAKind));
      }
    }
  }

  /// A log says when which zone was closed; else the scenario does.
  void read_closures(const Json& record) {
    if (!record.contains("zones")) {
      run_.setup.closures = all_closures(line_, {});
      return;
    }
    std::vector<std::string> names;
    for (const Zone& zone : line_.zones) names.push_back(zone.name);
    for (const Json& zone : record["zones"]) {
      const std::string name = zone.value("name", std::string());
      const auto found = std::find(names.begin(), names.end(), name);
      if (found == names.end()) {
        problem(fmt::format("zones: the line has no zone '{}'", name), name_hint(name, names));
        continue;
      }
      for (const Json& span : zone["closed"]) {
        const auto first = span[0].get<std::int64_t>();
        const auto ticks = span[1].get<std::int64_t>();
        if (first < 1 || first > kMaxTicks || ticks < 1 || ticks > kMaxTicks) {
          problem(fmt::format("zone '{}' is closed at {}", name, shorten(span)),
                  "write [tick, ticks]");
          continue;
        }
        run_.setup.closures.push_back({static_cast<std::int32_t>(found - names.begin()),
                                       static_cast<Tick>(first), static_cast<Tick>(first + ticks)});
      }
    }
    run_.setup.closures = joined_closures(std::move(run_.setup.closures));
  }

  const Task* find_task(const std::string& name, std::size_t number, TaskId& id) {
    std::vector<std::string> names;
    for (std::size_t t = 0; t < line_.tasks.size(); ++t) {
      if (line_.tasks[t].name == name) {
        id = TaskId(t);
        return &line_.tasks[t];
      }
      names.push_back(line_.tasks[t].name);
    }
    problem(fmt::format("decision {}: unknown task '{}'", number, name), name_hint(name, names));
    return nullptr;
  }

  /// Number of the first worker (carrier) of the slot's kind, and how many there are.
  std::pair<std::size_t, std::size_t> members_of(const CrewSlot& slot) const {
    const auto& groups = slot.worker ? run_.setup.worker_start : run_.setup.carrier_start;
    const std::size_t kind = slot.worker ? slot.worker->index() : slot.carrier->index();
    std::size_t first = 0;
    for (std::size_t k = 0; k < std::min(kind, groups.size()); ++k) first += groups[k].size();
    return {first, kind < groups.size() ? groups[kind].size() : 0};
  }

  void read_decision(const Json& entry, std::size_t number) {
    if (!entry.is_object() || !entry.contains("tick") || !entry.contains("task") ||
        !entry["tick"].is_number_integer() || !entry["task"].is_string()) {
      problem(fmt::format("decision {} is {}", number, shorten(entry)),
              "write {\"tick\": 1, \"task\": NAME, \"human\": 0, ...}");
      return;
    }
    RecordedDecision decision;
    const auto tick = entry["tick"].get<std::int64_t>();
    const Tick before = run_.decisions.empty() ? 0 : run_.decisions.back().tick;
    if (tick <= before || tick > kMaxTicks) {
      problem(fmt::format("decision {}: tick {} after tick {}", number, tick, before),
              "ticks start at 1 and increase: at most one decision per tick");
      return;
    }
    decision.tick = static_cast<Tick>(tick);
    const Task* task = find_task(entry["task"].get<std::string>(), number, decision.task);
    if (task == nullptr) return;
    std::map<std::string, std::size_t> seen;  // how many slots of the role are filled
    for (std::size_t slot = 0; slot < task->crew.size(); ++slot) {
      const std::string& role = task->crew[slot].role;
      const std::size_t rank = seen[role]++;
      if (!entry.contains(role) || entry[role].is_null()) continue;
      const Json& given = entry[role];
      if (given.is_array() && rank >= given.size()) continue;
      const Json& member = given.is_array() ? given[rank] : given;
      const auto [first, count] = members_of(task->crew[slot]);
      if (!member.is_number_integer() || member.get<std::int64_t>() < 0 ||
          member.get<std::int64_t>() >= static_cast<std::int64_t>(count)) {
        problem(
            fmt::format("decision {}: {} {} does not exist", number, role, shorten(member)),
            fmt::format("{}s are numbered 0 to {}", role, static_cast<std::int64_t>(count) - 1));
        continue;
      }
      decision.members[slot] = static_cast<std::int16_t>(first + member.get<std::size_t>());
    }
    if (entry.contains("joins")) read_joins(entry["joins"], *task, decision);
    run_.decisions.push_back(decision);
  }

  /// {"robot": [2, ...]}: who filled the slots that were left open at the decision, in their order.
  void read_joins(const Json& joins, const Task& task, RecordedDecision& decision) {
    std::map<std::string, std::size_t> seen;
    for (std::size_t slot = 0; slot < task.crew.size(); ++slot) {
      const std::string& role = task.crew[slot].role;
      if (decision.members[slot] >= 0 || !joins.is_object() || !joins.contains(role)) continue;
      const std::size_t rank = seen[role]++;
      if (!joins[role].is_array() || rank >= joins[role].size()) continue;
      const Json& member = joins[role][rank];
      const auto [first, count] = members_of(task.crew[slot]);
      if (!member.is_number_integer() || member.get<std::int64_t>() < 0 ||
          member.get<std::uint64_t>() >= count) {
        continue;
      }
      decision.joiners[slot] = static_cast<std::int16_t>(first + member.get<std::size_t>());
    }
  }

  void read_milestones(const Json& record) {
    if (!record.contains("milestones") || !record["milestones"].is_array()) return;
    std::size_t number = 0;
    for (const Json& entry : record["milestones"]) {
      ++number;
      if (!entry.is_array() || entry.size() < 2 || !entry[0].is_number_integer() ||
          !entry[1].is_string()) {
        problem(fmt::format("milestone {} is {}", number, shorten(entry)),
                "write [tick, name, label]");
        continue;
      }
      RecordedMilestone milestone;
      milestone.tick =
          static_cast<Tick>(std::clamp<std::int64_t>(entry[0].get<std::int64_t>(), 0, kMaxTicks));
      milestone.name = entry[1].get<std::string>();
      if (entry.size() > 2 && entry[2].is_string()) milestone.label = entry[2].get<std::string>();
      run_.milestones.push_back(std::move(milestone));
    }
  }

  // --- an event log of ours ---------------------------------------------------------------------

  void read_log(const std::string& text) {
    Json record{
        {"start", Json::object()}, {"decisions", Json::array()}, {"milestones", Json::array()}};
    std::size_t begin = 0;
    int number = 0;
    bool complete = false;
    while (begin < text.size()) {
      const std::size_t end = std::min(text.find('\n', begin), text.size());
      const Json line = parse(text.substr(begin, end - begin));
      begin = end + 1;
      ++number;
      if (!line.is_object()) {
        problem("is no JSON object", "the log is damaged or cut off; write it again", number);
        return;
      }
      if (number == 1) {
        header(line, record);
      } else {
        complete = event(line, record) || complete;
      }
    }
    if (!complete) problem("ends without 'end'", "the log is cut off; write it again", number);
    read_record(record);
    if (record.contains("horizon")) {
      run_.setup.horizon = integer(record, "horizon", 1, kMaxTicks).value_or(run_.setup.horizon);
    }
  }

  void header(const Json& head, Json& record) const {
    for (const WorkerKind& kind : line_.worker_kinds)
      record["start"][kind.name + "s"] = Json::array();
    for (const CarrierKind& kind : line_.carrier_kinds)
      record["start"][kind.name + "s"] = Json::array();
    const Json order = head.value("order", Json::object());
    if (order.is_object() && order.contains("quantity")) record["order"] = order["quantity"];
    if (head.contains("horizon")) record["horizon"] = head["horizon"];
    zones(head, record);
    for (const char* list : {"workers", "carriers"}) {
      const Json entries = head.value(list, Json::array());
      if (!entries.is_array()) continue;
      for (const Json& entry : entries) {
        if (!entry.is_object() || !entry.contains("kind") || !entry["kind"].is_string()) continue;
        Json& start = record["start"][entry["kind"].get<std::string>() + "s"];
        if (start.is_null()) start = Json::array();
        start.push_back(entry.value("start", Json()));
      }
    }
  }

  /// Takes over the zones, as far as they are well-formed.
  static void zones(const Json& head, Json& record) {
    record["zones"] = Json::array();
    const Json zones = head.value("zones", Json::array());
    if (!zones.is_array()) return;
    for (const Json& zone : zones) {
      if (!zone.is_object() || !zone.contains("name") || !zone["name"].is_string()) continue;
      Json spans = Json::array();
      const Json closed = zone.value("closed", Json::array());
      for (const Json& span : closed) {
        const bool fits = span.is_array() && span.size() == 2 && span[0].is_number_integer() &&
                          span[1].is_number_integer();
        if (fits) spans.push_back(span);
      }
      record["zones"].push_back({{"name", zone["name"]}, {"closed", std::move(spans)}});
    }
  }

  /// Takes over what a replay needs; true for the last event.
  static bool event(const Json& entry, Json& record) {
    const Json name = entry.value("event", Json());
    const Json tick = entry.value("t", Json());
    if (name == "decision") {
      Json decision{{"tick", tick}, {"task", entry.value("task", Json())}};
      const Json crew = entry.value("crew", Json::object());
      if (crew.is_object()) {
        for (const auto& [role, members] : crew.items()) decision[role] = numbers(members);
      }
      record["decisions"].push_back(std::move(decision));
    } else if (name == "join") {
      const Json n = entry.value("n", Json());
      const Json role = entry.value("role", Json());
      Json& decisions = record["decisions"];
      if (!n.is_number_integer() || !role.is_string()) return false;
      const auto serial = n.get<std::uint64_t>();  // a negative one is too large
      if (serial < 1 || serial > decisions.size()) return false;
      Json& joined = decisions[serial - 1]["joins"][role.get<std::string>()];
      for (const Json& number : numbers(Json::array({entry.value("worker", Json())})))
        joined.push_back(number);
    } else if (name == "milestone") {
      record["milestones"].push_back(Json::array({tick, entry.value("name", Json())}));
    } else if (name == "end") {
      record["finished"] = entry.value("status", Json()) == "finished";
      record["makespan"] = entry.value("makespan", Json());
      return true;
    }
    return false;
  }

  /// ["human.0", ...] as [0, ...]; what is no such name stays and is reported later.
  static Json numbers(const Json& members) {
    Json list = Json::array();
    if (!members.is_array()) return list;
    for (const Json& member : members) {
      const std::string id = member.is_string() ? member.get<std::string>() : std::string();
      const std::size_t dot = id.rfind('.');
      int number = -1;
      if (dot != std::string::npos)
        std::from_chars(id.data() + dot + 1, id.data() + id.size(), number);
      list.push_back(number >= 0 ? Json(number) : member);
    }
    return list;
  }

  const LineModel& line_;
  RecordedRun run_;
  std::vector<Diagnostic> problems_;
};

}  // namespace

RecordedRun load_recorded_run(const std::string& file, const LineModel& line) {
  std::ifstream in(file, std::ios::binary);
  if (!in) {
    throw ScenarioError(file, "cannot be read",
                        "name a record of decisions or an event log that exists");
  }
  const std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  return read_recorded_run(text, file, line);
}

RecordedRun read_recorded_run(const std::string& text, const std::string& file,
                              const LineModel& line) {
  return Reader(file, line).read(text);
}

}  // namespace linewright
