#include <algorithm>
#include <map>
#include <set>

#include "conditions.hpp"
#include "net_words.hpp"
#include "task_net.hpp"

namespace linewright::bounds {
namespace {

/// Items that every execution moves into (or out of) the place in any case.
int certain_items(const Task& task, PlaceId place, bool into) {
  int items = 0;
  for (const Step& step : task.steps) {
    for (const ActorSequence& sequence : step.sequences) {
      if (task.crew[sequence.slot].join_late) continue;
      for (const Action& action : sequence.actions) {
        const auto* transfer = std::get_if<TransferAction>(&action.what);
        if (transfer == nullptr) continue;
        const Endpoint& endpoint = into ? transfer->destination : transfer->source;
        if (endpoint.place == place) items += transfer->repeat;  // kUntilBlocked is 0
      }
    }
  }
  return items;
}

/// At the decision for the n-th execution, at least n - max_running have ended and moved their
/// items; then there must be `value` tokens (or as much room) besides.
void need(LineNet& net, std::size_t t, int event, int items, int value) {
  const Task& task = net.line.tasks[t];
  auto& arcs = net.net[net.tasks[t].start].arcs;
  arcs.push_back({.from = event, .lag = 1, .times = 0, .plus = value});
  if (items > 0) {
    arcs.push_back(
        {.from = event, .lag = 1, .times = items, .plus = value - task.max_running * items});
  }
}

/// `value` tokens must lie in the place.
void need_tokens(LineNet& net, std::size_t t, PlaceId place, int value) {
  if (net.line.places[place.index()].berth) return;
  need(net, t, net.arrivals[place.index()], certain_items(net.line.tasks[t], place, false), value);
}

/// Each token that has left the place has been taken by an operation that held the machine: the
/// event that it has let it go again. None: it is not so.
std::optional<int> let_go_by_takers(LineNet& net, PlaceId place, MachineId machine) {
  Event let_go{.name = net.line.machines[machine.index()].name + " let go again", .counts = true};
  bool claimed = false;
  for (const Flow& flow : net.flows) {
    const int taken = tokens_in(flow.takes, place.value);
    if (taken == 0) continue;
    if (taken > 1 || !flow.operation) return std::nullopt;
    const Operation& operation = net.line.operations[flow.operation->index()];
    if (find(operation.uses, machine) != nullptr) {
      let_go.sources.push_back({net.freed[flow.operation->index()], 1});
    } else if (find(operation.claims, machine) != nullptr) {
      claimed = true;
    } else {
      return std::nullopt;
    }
  }
  if (claimed) let_go.sources.push_back({net.machine_freed[machine.index()], 1});
  return net.net.add(std::move(let_go));
}

/// There must be room for `value` tokens; and what that says of machines that must be free.
void need_room(LineNet& net, std::size_t t, PlaceId place, int value) {
  const Place& where = net.line.places[place.index()];
  if (where.berth || !where.capacity) return;
  const int items = certain_items(net.line.tasks[t], place, true);
  const int plus = net.initial(place.value) - *where.capacity + value;
  need(net, t, net.departures[place.index()], items, plus);
  if (items == 0) return;
  for (const LowerLimit& limit : lower_limits(net.line.tasks[t].when, net.setup.order)) {
    if (limit.variable.kind != VariableKind::kMachineFree) continue;
    const auto let_go = let_go_by_takers(net, place, MachineId(limit.variable.index));
    if (let_go) need(net, t, *let_go, items, plus);
  }
}

void add_start(LineNet& net, std::size_t t) {
  const Task& task = net.line.tasks[t];
  net.net[net.tasks[t].start].arcs.push_back(
      {.from = net.tasks[t].end, .lag = 1, .plus = -task.max_running});
  std::map<std::pair<std::int32_t, bool>, int> wanted;
  for (const Reservation& reservation : task.reserves)
    ++wanted[{reservation.place.value, reservation.room}];
  for (const auto& [place, value] : wanted) {
    if (place.second) {
      need_room(net, t, PlaceId(place.first), value);
    } else {
      need_tokens(net, t, PlaceId(place.first), value);
    }
  }
  for (const LowerLimit& limit : lower_limits(task.when, net.setup.order)) {
    const PlaceId place(limit.variable.index);
    switch (limit.variable.kind) {
      case VariableKind::kPlaceCount:
      case VariableKind::kPlaceAvailable:
        need_tokens(net, t, place, limit.value);
        break;
      case VariableKind::kPlaceRoom:
        need_room(net, t, place, limit.value);
        break;
      default:
        break;
    }
    if (auto arc = arc_for(net, limit)) {
      arc->lag = 1;
      net.net[net.tasks[t].start].arcs.push_back(*arc);
    }
  }
}

}  // namespace

void add_tasks(LineNet& net) {
  for (const Task& task : net.line.tasks) {
    TaskEvents events;
    events.start = net.net.add({.name = task.name + " decided", .least = 1});
    events.end = net.net.add({.name = task.name + " ends"});
    net.tasks.push_back(std::move(events));
  }
  for (std::size_t t = 0; t < net.line.tasks.size(); ++t) TaskNet(net, TaskId(t)).build();
  for (std::size_t t = 0; t < net.line.tasks.size(); ++t) add_start(net, t);
}

}  // namespace linewright::bounds
