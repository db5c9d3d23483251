#include <algorithm>

#include "conditions.hpp"
#include "line_net.hpp"

namespace linewright::bounds {
namespace {

std::size_t at(std::int32_t id) { return static_cast<std::size_t>(id); }

/// Whether what is in a carrier can leave it while it stands in the berth.
bool drained_in_berth(const LineModel& line, PlaceId berth) {
  for (const Operation& operation : line.operations) {
    for (const TokenFlow& flow : operation.consumes) {
      if (flow.place == berth) return true;
    }
  }
  for (const Task& task : line.tasks) {
    for (const Step& step : task.steps) {
      for (const ActorSequence& sequence : step.sequences) {
        for (const Action& action : sequence.actions) {
          const auto* transfer = std::get_if<TransferAction>(&action.what);
          if (transfer != nullptr && transfer->source.place == berth) return true;
        }
      }
    }
  }
  return false;
}

/// Tokens need room: a free place, or a carrier that stands there.
void need_room(LineNet& net, const TokenFlow& flow, std::vector<Arc>& arcs) {
  const Place& place = net.line.places[flow.place.index()];
  if (place.berth) {
    const int capacity = net.line.carrier_kinds[place.berth->carrier.index()].capacity;
    const bool drained = drained_in_berth(net.line, flow.place);
    arcs.push_back({.from = net.parked[flow.place.index()],
                    .times = drained ? 0 : flow.count,
                    .plus = drained ? 1 : 0,
                    .divide = drained ? 1 : capacity});
  } else if (place.capacity) {
    arcs.push_back({.from = net.departures[flow.place.index()],
                    .times = flow.count,
                    .plus = net.initial(flow.place.value) - *place.capacity});
  }
}

void connect(LineNet& net, std::size_t o) {
  const Operation& operation = net.line.operations[o];
  std::vector<Arc> arcs;
  Flow flow{.operation = OperationId(o)};
  for (const TokenFlow& taken : operation.consumes) {
    const int store = net.stores.of(taken.place);
    arcs.push_back({.from = net.arrivals[at(store)], .times = taken.count});
    net.net[net.departures[at(store)]].sources.push_back({net.starts[o], taken.count});
    flow.takes.emplace_back(store, taken.count);
  }
  for (const TokenFlow& given : operation.produces) {
    const int store = net.stores.of(given.place);
    need_room(net, given, arcs);
    net.net[net.arrivals[at(store)]].sources.push_back({net.ends[o], given.count});
    flow.gives.emplace_back(store, given.count);
  }
  // Whoever claims a machine finds it let go by those before; whoever only uses it lets it go
  // itself.
  if (!operation.uses.empty()) arcs.push_back({.from = net.freed[o], .plus = -1});
  for (const MachineUse& use : operation.claims)
    arcs.push_back({.from = net.machine_freed[use.machine.index()], .plus = -1});
  for (const MachineUse& use : operation.frees) {
    arcs.push_back({.from = net.machine_claimed[use.machine.index()]});
    net.net[net.machine_freed[use.machine.index()]].sources.push_back({net.freed[o], 1});
  }
  for (const MachineUse& use : operation.claims)
    net.net[net.machine_claimed[use.machine.index()]].sources.push_back({net.ends[o], 1});
  for (const LowerLimit& limit : lower_limits(operation.when, net.setup.order)) {
    if (const auto needed = arc_for(net, limit)) arcs.push_back(*needed);
  }
  if (operation.operated_by) arcs.push_back({.from = net.tries[o]});
  net.net[net.starts[o]].arcs = std::move(arcs);
  flow.least = operation.takes + least_travel(net.line, operation);
  net.net[net.ends[o]].arcs.push_back({.from = net.starts[o], .lag = flow.least});
  net.net[net.freed[o]].arcs.push_back({.from = net.ends[o], .lag = operation.recovery});
  net.flows.push_back(std::move(flow));
}

}  // namespace

void add_operations(LineNet& net) {
  for (const Operation& operation : net.line.operations) {
    net.tries.push_back(net.net.add({.name = operation.name + " tried", .counts = true}));
    net.starts.push_back(net.net.add({.name = operation.name + " starts", .least = 1}));
    net.ends.push_back(net.net.add({.name = operation.name + " ends"}));
    net.freed.push_back(net.net.add({.name = operation.name + " lets go"}));
  }
  for (std::size_t o = 0; o < net.line.operations.size(); ++o) connect(net, o);
}

}  // namespace linewright::bounds
