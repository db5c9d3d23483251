#include "log_explanations.hpp"

namespace linewright::event_log {
namespace {

using Json = nlohmann::ordered_json;

Json alternatives(const LineModel& line, const DecisionExplanation& explanation) {
  Json list = Json::array();
  for (const auto& alternative : explanation.alternatives) {
    Json& entry = list.emplace_back(Json{{"task", line.tasks[alternative.task.index()].name}});
    if (alternative.ruled_out) {
      entry["ruled_out"] = true;
    } else {
      entry["ends"] = alternative.estimate ? Json(*alternative.estimate) : Json();
    }
  }
  return list;
}

Json candidates(const std::vector<std::string>& workers,
                const DecisionExplanation::Member& member) {
  Json list = Json::array();
  for (const auto& candidate : member.candidates) {
    Json& entry = list.emplace_back(Json{{"worker", workers[candidate.worker.index()]}});
    if (!member.needed_at) continue;
    entry["ticks"] = candidate.way.ticks < 0 ? Json() : Json(candidate.way.ticks);
    if (candidate.way.ticks >= 0) entry["metres"] = candidate.way.metres;
  }
  return list;
}

}  // namespace

Json explanation_json(const LineModel& line, const std::vector<std::string>& workers,
                      const DecisionExplanation& explanation) {
  Json why{{"alternatives", alternatives(line, explanation)},
           {"not_selectable", Json::object()},
           {"candidates", Json::object()}};
  if (explanation.planned_end) why["planned_end"] = *explanation.planned_end;
  for (const auto& task : explanation.unselectable) {
    why["not_selectable"][line.tasks[task.task.index()].name] = task.reason;
  }
  for (const auto& member : explanation.members) {
    Json& role = why["candidates"][member.role];
    role = {{"free", candidates(workers, member)}};
    if (member.needed_at) role["needed_at"] = line.stations[member.needed_at->index()].name;
  }
  return why;
}

}  // namespace linewright::event_log
