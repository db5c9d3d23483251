#include "needed_ways.hpp"

#include <set>

#include "task_actions.hpp"

namespace linewright::loading {
namespace {

/// Where a fetch can lead: where such carriers start. Where a mover leaves one it was sent to
/// itself.
void add_fetched(const LineModel& line, const Task& task, const FetchAction& fetch,
                 std::set<StationId>& stations) {
  const auto carrier = task.crew[fetch.carrier_slot].carrier;
  if (!carrier) return;
  const CarrierKind& kind = line.carrier_kinds[carrier->index()];
  const std::vector<StationId> start = start_stations(line, kind.moved_by, kind.start);
  stations.insert(start.begin(), start.end());
}

void add_targets(const LineModel& line, const Task& task, WorkerKindId kind,
                 std::set<StationId>& stations) {
  for_each_action(task, [&](const Action& action, std::size_t slot) {
    if (task.crew[slot].worker != kind) return;
    if (const auto* go = std::get_if<GoAction>(&action.what)) stations.insert(go->station);
    if (const auto* fetch = std::get_if<FetchAction>(&action.what)) {
      add_fetched(line, task, *fetch, stations);
    }
  });
}

}  // namespace

std::vector<StationId> start_stations(const LineModel& line, WorkerKindId kind,
                                      const std::vector<StationId>& start) {
  if (!start.empty()) return start;
  std::vector<StationId> stations;
  for (std::size_t i = 0; i < line.stations.size(); ++i) {
    if (line.stations[i].poses[kind.index()]) stations.emplace_back(i);
  }
  return stations;
}

NeededWays needed_ways(const LineModel& line, WorkerKindId kind) {
  std::set<StationId> targets;
  for (const Task& task : line.tasks) add_targets(line, task, kind, targets);
  const std::vector<StationId>& rest = line.worker_kinds[kind.index()].rest;
  targets.insert(rest.begin(), rest.end());
  std::set<StationId> origins = targets;
  const auto start = start_stations(line, kind, line.worker_kinds[kind.index()].start);
  origins.insert(start.begin(), start.end());
  return {{origins.begin(), origins.end()}, {targets.begin(), targets.end()}};
}

}  // namespace linewright::loading
