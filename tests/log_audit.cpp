#include "tests/log_audit.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace linewright::testing {

using Json = nlohmann::json;

Audit::Audit(const std::string& text) {
  std::istringstream in(text);
  std::string line;
  std::getline(in, line);
  head_ = Json::parse(line);
  for (const Json& place : head_["places"]) {
    count_[place["name"]] = place["initial"];
    if (place.contains("capacity")) capacity_[place["name"]] = place["capacity"];
    if (place.contains("berth")) berths_.insert(place["name"].get<std::string>());
  }
  for (const Json& carrier : head_["carriers"]) {
    count_[carrier["id"]] = 0;
    capacity_[carrier["id"]] = carrier["capacity"];
  }
  for (const Json& operation : head_["operations"]) operations_[operation["name"]] = operation;
  while (std::getline(in, line)) events_.push_back(Json::parse(line));
  place_workers();
  run();
}

void Audit::run() {
  // Items under way by hand are put down at their `until`.
  std::multimap<int, std::pair<std::string, std::string>> in_hand;
  int now = 0;
  for (const Json& event : events_) {
    const int tick = event["t"];
    if (tick < now) problem = "time runs backwards at " + event.dump();
    now = tick;
    while (!in_hand.empty() && in_hand.begin()->first <= now) {
      move(in_hand.begin()->second.first, -1, event);
      move(in_hand.begin()->second.second, +1, event);
      in_hand.erase(in_hand.begin());
    }
    const std::string what = event["event"];
    if (what == "transfer") {
      in_hand.emplace(event["until"].get<int>(), std::pair{event["from"], event["to"]});
    } else if (what == "operation_start") {
      machines(event, true);
      for (const auto& [place, n] : flows(event, "consumes")) move(place, -n, event);
    } else if (what == "operation_end") {
      for (const auto& [place, n] : flows(event, "produces")) move(place, n, event);
      const Json& operation = operations_[event["operation"]];
      if (!operation.contains("recovery")) machines(event, false);
    } else if (what == "recovery_end") {
      machines(event, false);
    } else if (what == "put_down" && event.contains("berth")) {
      standing_[event["berth"]] = event["carrier"];
    } else if (what == "berth") {
      standing_[event["berth"]] = event["carrier"];
    } else if (what == "decision") {
      crew(event, true);
    } else if (what == "task_end" || what == "release" || what == "join") {
      crew(event, what == "join");
    } else if (what == "go" || what == "reroute" || what == "blocked") {
      follow_way(event);
    } else if (what == "zone") {
      change_zone(event);
    }
  }
}

std::map<std::string, int> Audit::flows(const Json& event, const char* key) {
  const Json& operation = operations_[event["operation"]];
  return operation.contains(key) ? operation[key].get<std::map<std::string, int>>()
                                 : std::map<std::string, int>{};
}

void Audit::move(std::string where, int n, const Json& event) {
  if (berths_.contains(where)) {
    if (!standing_.contains(where)) {
      problem = "nothing stands in " + where + " at " + event.dump();
      return;
    }
    where = standing_[where];
  }
  int& count = count_[where];
  count += n;
  if (count < 0) problem = where + " has " + std::to_string(count) + " at " + event.dump();
  if (capacity_.contains(where) && count > capacity_[where]) {
    problem = where + " holds too much at " + event.dump();
  }
}

void Audit::machines(const Json& event, bool take) {
  const Json& operation = operations_[event["operation"]];
  const auto each = [&](const char* key, auto&& what) {
    if (!operation.contains(key)) return;
    for (const Json& machine : operation[key]) what(machine.get<std::string>());
  };
  const auto take_it = [&](const std::string& machine) {
    if (!taken_.insert(machine).second) problem = machine + " taken twice at " + event.dump();
  };
  const auto let_go = [&](const std::string& machine) {
    if (taken_.erase(machine) == 0) problem = machine + " was not taken at " + event.dump();
  };
  if (take) {
    each("uses", take_it);
    each("claims", take_it);
  } else {
    each("uses", let_go);
    each("frees", let_go);
  }
}

void Audit::crew(const Json& event, bool bind) {
  if (event["event"] == "decision") {
    for (const auto& [role, members] : event["crew"].items()) {
      for (const Json& member : members) {
        bound_to_[event["n"]].push_back(member);
        const std::string id = member;
        for (auto berth = standing_.begin(); berth != standing_.end();) {
          berth = berth->second == id ? standing_.erase(berth) : std::next(berth);
        }
        if (!busy_.insert(id).second) problem = id + " is busy already at " + event.dump();
      }
    }
  } else if (event["event"] == "join") {
    if (bind && !busy_.insert(event["worker"]).second)
      problem = "joiner is busy at " + event.dump();
    bound_to_[event["n"]].push_back(event["worker"]);
  } else if (event["event"] == "release") {
    busy_.erase(event["worker"]);
    std::erase(bound_to_[event["n"]], event["worker"].get<std::string>());
  } else {
    for (const std::string& member : bound_to_[event["n"]]) busy_.erase(member);
  }
}

std::vector<double> Audit::station(const std::string& name, const std::string& kind) const {
  return head_["stations"][name][kind].get<std::vector<double>>();
}

void Audit::place_workers() {
  for (const Json& worker : head_["workers"]) {
    Motion& motion = motions_[worker["id"]];
    motion.kind = worker["kind"];
    motion.from = motion.to = station(worker["start"], motion.kind);
  }
}

std::vector<double> Audit::pose_of(const Motion& motion, int tick) {
  if (motion.stopped || (tick <= motion.departs && tick < motion.arrives)) return motion.from;
  if (tick >= motion.arrives) return motion.to;
  const double share = double(tick - motion.departs) / (motion.arrives - motion.departs);
  std::vector<double> before = motion.from;
  double passed = 0.0;
  Json points = motion.path;
  points.push_back({motion.to[0], motion.to[1], motion.to[2], 1.0});
  for (const Json& point : points) {
    const double at = point[3];
    if (at >= share && at > passed) {
      const double part = (share - passed) / (at - passed);
      return {before[0] + part * (double(point[0]) - before[0]),
              before[1] + part * (double(point[1]) - before[1]), 0.0};
    }
    before = {point[0], point[1], point[2]};
    passed = at;
  }
  return motion.to;
}

/// A worker never jumps.
void Audit::expect_at(const Json& event, const Motion& motion, const std::vector<double>& pose) {
  const std::vector<double> is = pose_of(motion, event["t"]);
  if (std::hypot(is[0] - pose[0], is[1] - pose[1]) > 1e-6) {
    problem = "the worker is at " + Json(is).dump() + " at " + event.dump();
  }
}

void Audit::follow_way(const Json& event) {
  const std::string worker = event["worker"];
  Motion& motion = motions_.at(worker);
  const std::string what = event["event"];
  const bool bound = busy_.contains(worker);
  if (what != "blocked" && event.contains("n") != bound) {
    problem = "a way for the wrong task at " + event.dump();
  }
  const std::vector<double> here =
      what == "go" ? station(event["from"], motion.kind) : event["pose"].get<std::vector<double>>();
  expect_at(event, motion, here);
  motion.from = here;
  motion.stopped = what == "blocked";
  if (motion.stopped) return;
  motion.to = station(event["to"], motion.kind);
  motion.departs = event["departs"];
  motion.arrives = event["arrives"];
  motion.path = event.value("path", Json::array());
  if (motion.departs < event["t"] || motion.arrives < motion.departs) {
    problem = "a way ends before it begins at " + event.dump();
  }
}

/// As the header says, neither more nor less.
void Audit::change_zone(const Json& event) {
  const std::string zone = event["zone"];
  const bool closes = event["closed"];
  if (closes != closed_.insert(zone).second) problem = "the zone was so already at " + event.dump();
  if (!closes) closed_.erase(zone);
  bool announced = false;
  for (const Json& known : head_["zones"]) {
    if (known["name"] != zone) continue;
    for (const Json& span : known["closed"]) {
      const int tick = closes ? int(span[0]) : int(span[0]) + int(span[1]);
      announced = announced || tick == event["t"];
    }
  }
  if (!announced) problem = "the header does not announce " + event.dump();
}

}  // namespace linewright::testing
