#include "task_facts.hpp"

#include <algorithm>
#include <variant>

namespace linewright::planning {
namespace {

/// Turns what lies in `from` into what lies in `to`.
struct Transition {
  std::vector<PlaceId> from;
  std::vector<PlaceId> to;
  double ticks = 0.0;
};

void add(std::vector<PlaceId>& places, PlaceId place) {
  if (std::find(places.begin(), places.end(), place) == places.end()) places.push_back(place);
}

/// The shortest time in which the machine gets where the operation needs it.
Tick shortest_travel(const LineModel& line, const MachineUse& use) {
  if (!use.from) return 0;
  const Machine& machine = line.machines[use.machine.index()];
  Tick least = -1;
  for (const Tick ticks : machine.travel[static_cast<std::size_t>(*use.from)]) {
    if (ticks >= 0 && (least < 0 || ticks < least)) least = ticks;
  }
  return std::max(0, least);
}

double ticks_of(const LineModel& line, const Operation& operation) {
  Tick travel = 0;
  for (const auto* uses : {&operation.uses, &operation.claims, &operation.frees}) {
    for (const MachineUse& use : *uses) travel = std::max(travel, shortest_travel(line, use));
  }
  return operation.takes + travel;
}

bool holds(const Operation& operation, MachineId machine) {
  for (const auto* uses : {&operation.uses, &operation.claims, &operation.frees}) {
    for (const MachineUse& use : *uses) {
      if (use.machine == machine) return true;
    }
  }
  return false;
}

/// Adds up the work of one task.
class WorkOfTask {
 public:
  WorkOfTask(const LineModel& line, const Task& task)
      : line_(line), task_(task), stands_(task.crew.size()) {
    for (std::size_t slot = 0; slot < task.crew.size(); ++slot) {
      if (task.crew[slot].carrier && task.crew[slot].wanted == CarrierWanted::kBerth) {
        stands_[slot] = line.places[task.crew[slot].berth.index()].at;
      }
    }
  }

  TaskFacts facts() {
    TaskFacts facts;
    for (const Step& step : task_.steps) {
      double longest = 0.0;
      for (const ActorSequence& sequence : step.sequences) {
        double ticks = 0.0;
        for (const Action& action : sequence.actions) {
          ticks += action.before + action.after + act(sequence.slot, action, facts);
        }
        longest = std::max(longest, ticks);
      }
      facts.work += longest;
    }
    return facts;
  }

 private:
  double act(std::size_t slot, const Action& action, TaskFacts& facts) {
    if (const auto* go = std::get_if<GoAction>(&action.what)) return travel(slot, go->station);
    if (const auto* fetch = std::get_if<FetchAction>(&action.what)) {
      const auto station = stands_[fetch->carrier_slot];
      if (station) return travel(slot, *station);
      stands_[slot].reset();  // wherever the carrier is
      return 0.0;
    }
    if (const auto* park = std::get_if<ParkAction>(&action.what)) {
      if (park->berth) add(facts.buffers, *park->berth);
      return 0.0;
    }
    if (const auto* transfer = std::get_if<TransferAction>(&action.what)) {
      if (const auto place = place_of(transfer->source)) add(facts.sources, *place);
      if (transfer->destination.place) add(facts.buffers, *transfer->destination.place);
      return static_cast<double>(transfer->takes) * items(*transfer);
    }
    if (const auto* operate = std::get_if<OperateAction>(&action.what)) {
      const Operation& operation = line_.operations[operate->operation.index()];
      for (const TokenFlow& flow : operation.consumes) add(facts.sources, flow.place);
      for (const TokenFlow& flow : operation.produces) add(facts.buffers, flow.place);
      return ticks_of(line_, operation);
    }
    return 0.0;
  }

  double travel(std::size_t slot, StationId to) {
    const auto from = stands_[slot];
    stands_[slot] = to;
    if (!from || !task_.crew[slot].worker) return 0.0;
    return std::max(0, line_.travel[task_.crew[slot].worker->index()].leg(*from, to).ticks);
  }

  /// The place, or the berth in which the carrier stood.
  [[nodiscard]] std::optional<PlaceId> place_of(const Endpoint& endpoint) const {
    if (endpoint.place) return endpoint.place;
    const CrewSlot& slot = task_.crew[endpoint.slot];
    if (slot.wanted == CarrierWanted::kBerth) return slot.berth;
    return std::nullopt;
  }

  [[nodiscard]] double items(const TransferAction& transfer) const {
    if (transfer.repeat != TransferAction::kUntilBlocked) return transfer.repeat;
    std::optional<std::int32_t> least;
    for (const Endpoint* endpoint : {&transfer.source, &transfer.destination}) {
      const auto capacity = endpoint->place ? line_.places[endpoint->place->index()].capacity
                                            : std::optional(capacity_of_carrier(endpoint->slot));
      if (capacity && (!least || *capacity < *least)) least = capacity;
    }
    return least.value_or(1);
  }

  [[nodiscard]] std::int32_t capacity_of_carrier(std::size_t slot) const {
    const auto kind = task_.crew[slot].carrier;
    return kind ? line_.carrier_kinds[kind->index()].capacity : 1;
  }

  const LineModel& line_;
  const Task& task_;
  std::vector<std::optional<StationId>>
      stands_;  ///< by crew slot: where it is, if the task says so
};

std::optional<MachineId> bottleneck_of(const LineModel& line) {
  std::optional<MachineId> found;
  double most = -1.0;
  for (std::size_t m = 0; m < line.machines.size(); ++m) {
    double ticks = 0.0;
    for (const Operation& operation : line.operations) {
      if (holds(operation, MachineId(m))) ticks += ticks_of(line, operation);
    }
    if (ticks <= most) continue;
    most = ticks;
    found = MachineId(m);
  }
  return found;
}

double least(const std::vector<PlaceId>& places, const std::vector<double>& ticks) {
  double found = kNowhere;
  for (const PlaceId place : places) found = std::min(found, ticks[place.index()]);
  return found;
}

/// By place: the shortest time to one where `ticks` is 0 already.
void spread(const std::vector<Transition>& transitions, std::vector<double>& ticks) {
  for (bool again = true; again;) {
    again = false;
    for (const Transition& transition : transitions) {
      const double through = transition.ticks + least(transition.to, ticks);
      for (const PlaceId place : transition.from) {
        if (through >= ticks[place.index()]) continue;
        ticks[place.index()] = through;
        again = true;
      }
    }
  }
}

std::vector<PlaceId> places_of(const std::vector<TokenFlow>& flows) {
  std::vector<PlaceId> places;
  for (const TokenFlow& flow : flows) add(places, flow.place);
  return places;
}

}  // namespace

LineFacts facts_of(const LineModel& line) {
  LineFacts facts;
  std::vector<Transition> transitions;
  for (const Operation& operation : line.operations) {
    if (operation.operated_by) continue;  // part of a task
    transitions.push_back({.from = places_of(operation.consumes),
                           .to = places_of(operation.produces),
                           .ticks = ticks_of(line, operation)});
  }
  for (const Task& task : line.tasks) {
    facts.tasks.push_back(WorkOfTask(line, task).facts());
    const TaskFacts& own = facts.tasks.back();
    transitions.push_back({.from = own.sources, .to = own.buffers, .ticks = own.work});
  }
  std::vector<double> tail(line.places.size(), kNowhere);
  tail[line.order.finished_in.index()] = 0.0;
  spread(transitions, tail);

  std::vector<double> to_bottleneck(line.places.size(), kNowhere);
  facts.bottleneck = bottleneck_of(line);
  for (const Operation& operation : line.operations) {
    if (!facts.bottleneck || !holds(operation, *facts.bottleneck)) continue;
    for (const TokenFlow& flow : operation.consumes) to_bottleneck[flow.place.index()] = 0.0;
  }
  spread(transitions, to_bottleneck);

  facts.pace.assign(line.places.size(), kNowhere);
  for (const Transition& transition : transitions) {
    for (const PlaceId place : transition.from) {
      facts.pace[place.index()] = std::min(facts.pace[place.index()], transition.ticks);
    }
  }
  for (TaskFacts& task : facts.tasks) {
    task.tail = least(task.buffers, tail);
    task.to_bottleneck = least(task.buffers, to_bottleneck);
  }
  return facts;
}

}  // namespace linewright::planning
