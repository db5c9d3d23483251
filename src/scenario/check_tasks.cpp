#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "build_state.hpp"
#include "limits.hpp"
#include "linewright/scenario/values.hpp"
#include "task_actions.hpp"

namespace linewright::loading {
namespace {

bool loads_a_carrier(const Task& task) {
  bool found = false;
  for_each_action_of<TransferAction>(
      task, [&](const TransferAction& transfer) { found |= !transfer.destination.place; });
  return found;
}

/// Follows the crew through the steps: where each is, who holds what, what can be in a carrier.
class TaskWalk {
 public:
  TaskWalk(const BuildState& state, std::int32_t id)
      : state_(state),
        id_(id),
        task_(state.line().tasks[static_cast<std::size_t>(id)]),
        source_(state.task_sources[static_cast<std::size_t>(id)]),
        members_(task_.crew.size()) {
    for (std::size_t i = 0; i < members_.size(); ++i) {
      if (task_.crew[i].carrier) members_[i].contents = contents_at_start(task_.crew[i]);
    }
  }

  void run() {
    for (std::size_t s = 0; s < task_.steps.size(); ++s) {
      // What others load in the same step may arrive before this one unloads.
      for_each_action(s, [this](const Action& action, std::size_t) { note_loaded(action); });
      for_each_action(s, [this](const Action& action, std::size_t slot) { follow(action, slot); });
    }
  }

 private:
  struct Member {
    bool gone = false;                 ///< released, or parked in a berth
    std::optional<StationId> station;  ///< workers: where the task sent it last
    std::optional<std::size_t> holds;  ///< workers: slot of the carrier
    bool is_held = false;              ///< carriers
    /// Carriers: materials that can be in it; none: anything.
    std::optional<std::set<std::string>> contents;
  };

  template <class Visit>
  void for_each_action(std::size_t step, const Visit& visit) {
    const auto& sequences = task_.steps[step].sequences;
    for (std::size_t i = 0; i < sequences.size(); ++i) {
      for (std::size_t a = 0; a < sequences[i].actions.size(); ++a) {
        mark_ = source_.actions[step][i][a];
        visit(sequences[i].actions[a], sequences[i].slot);
      }
    }
  }

  void error(const std::string& message, std::string hint) {
    state_.problems.error(mark_,
                          fmt::format("{}: {}", state_.names.title(Section::kTasks, id_), message),
                          std::move(hint));
  }

  [[nodiscard]] std::string role(std::size_t slot) const {
    return in_quotes(task_.crew[slot].role);
  }
  [[nodiscard]] const Place& place(PlaceId id) const { return state_.line().places[id.index()]; }

  /// What lies in the place, or nothing when that depends on what the berth's carrier holds.
  [[nodiscard]] std::optional<std::string> material(PlaceId id) const {
    const Place& p = place(id);
    if (p.of.empty() && p.berth) return std::nullopt;
    return p.of.empty() ? p.name : p.of;
  }

  [[nodiscard]] std::optional<std::set<std::string>> contents_at_start(const CrewSlot& slot) const {
    if (slot.wanted == CarrierWanted::kEmpty) return std::set<std::string>{};
    if (slot.wanted == CarrierWanted::kAny || !is_parked_empty(slot.berth)) return std::nullopt;
    const auto parked = material(slot.berth);
    return parked ? std::optional(std::set<std::string>{*parked}) : std::nullopt;
  }

  /// Whether every carrier that comes into the berth is empty then, so that only operations fill
  /// it.
  [[nodiscard]] bool is_parked_empty(PlaceId berth) const {
    const auto& tasks = state_.line().tasks;
    return std::all_of(tasks.begin(), tasks.end(), [&](const Task& task) {
      if (!parks_in(task, berth)) return true;
      return !loads_a_carrier(task) &&
             std::all_of(task.crew.begin(), task.crew.end(), [](const CrewSlot& member) {
               return !member.carrier || member.wanted == CarrierWanted::kEmpty;
             });
    });
  }

  void note_loaded(const Action& action) {
    const auto* transfer = std::get_if<TransferAction>(&action.what);
    if (transfer == nullptr || transfer->destination.place) return;
    auto& contents = members_[transfer->destination.slot].contents;
    if (!contents) return;
    const auto loaded =
        transfer->source.place ? material(*transfer->source.place) : std::optional<std::string>();
    if (loaded) {
      contents->insert(*loaded);
    } else {
      contents.reset();  // from a carrier: could be anything
    }
  }

  void follow(const Action& action, std::size_t slot) {
    if (members_[slot].gone) {
      error(fmt::format("{} acts after its release", role(slot)), "let release be its last action");
      return;
    }
    std::visit([&](const auto& what) { act(what, slot); }, action.what);
  }

  void act(const GoAction& go, std::size_t slot) {
    const Station& station = state_.line().stations[go.station.index()];
    const WorkerKindId kind = *task_.crew[slot].worker;
    members_[slot].station = go.station;
    const bool sound = state_.is_sound(Section::kStations, go.station.value);
    if (!sound || station.poses[kind.index()]) return;
    error(fmt::format("station {} has no pose for {}", in_quotes(station.name), role(slot)),
          fmt::format("give the station {}: [x_m, y_m, yaw_rad]", task_.crew[slot].role));
  }

  void act(const FetchAction& fetch, std::size_t slot) {
    Member& worker = members_[slot];
    Member& carrier = members_[fetch.carrier_slot];
    const CarrierKindId kind_id = *task_.crew[fetch.carrier_slot].carrier;
    const WorkerKindId mover = state_.line().carrier_kinds[kind_id.index()].moved_by;
    if (!state_.is_sound(Section::kCarriers, kind_id.value)) return;
    const std::string& mover_name = state_.line().worker_kinds[mover.index()].name;
    if (task_.crew[slot].worker != mover) {
      error(fmt::format("{} cannot fetch {}, which is moved by {}", role(slot),
                        role(fetch.carrier_slot), in_quotes(mover_name)),
            fmt::format("let {} of the crew do it", in_quotes(mover_name)));
    } else if (carrier.gone || carrier.is_held || worker.holds) {
      error(fmt::format("{} fetches {}, {}", role(slot), role(fetch.carrier_slot),
                        carrier.gone   ? "which has left the task"
                        : worker.holds ? "but holds a carrier already"
                                       : "which somebody holds already"),
            carrier.gone ? "a carrier parked in a berth is for another task"
                         : "park it first, or remove this");
    }
    worker.holds = fetch.carrier_slot;
    carrier.is_held = true;
    // It stands where the carrier stood now, which is not known here.
    worker.station.reset();
  }

  void act(const ParkAction& park, std::size_t slot) {
    Member& worker = members_[slot];
    if (worker.holds != park.carrier_slot) {
      error(fmt::format("{} parks {} without holding it", role(slot), role(park.carrier_slot)),
            fmt::format("fetch it first: {{fetch: {}}}", task_.crew[park.carrier_slot].role));
    }
    if (park.berth) check_berth(park, worker.station);
    worker.holds.reset();
    members_[park.carrier_slot].is_held = false;
    members_[park.carrier_slot].gone = park.berth.has_value();
  }

  void check_berth(const ParkAction& park, std::optional<StationId> station) {
    const Place& berth = place(*park.berth);
    if (!state_.is_sound(Section::kPlaces, park.berth->value)) return;
    const std::string name = in_quotes(berth.name);
    if (!berth.berth) {
      error(fmt::format("place {} is no berth", name),
            fmt::format("give the place carrier: {}", task_.crew[park.carrier_slot].role));
    } else if (berth.berth->carrier != *task_.crew[park.carrier_slot].carrier) {
      const std::string& other = state_.line().carrier_kinds[berth.berth->carrier.index()].name;
      error(fmt::format("berth {} is for {}, not for {}", name, in_quotes(other),
                        role(park.carrier_slot)),
            fmt::format("name a berth for {}", role(park.carrier_slot)));
    } else if (berth.at && station && *berth.at != *station) {
      const auto& stations = state_.line().stations;
      error(fmt::format("berth {} is at {}, but its mover is at {}", name,
                        in_quotes(stations[berth.at->index()].name),
                        in_quotes(stations[station->index()].name)),
            fmt::format("go there first: {{go: {}}}", stations[berth.at->index()].name));
    }
  }

  void act(const TransferAction& transfer, std::size_t) {
    const Endpoint& from = transfer.source;
    const Endpoint& to = transfer.destination;
    if (!to.place) return;
    const auto wanted = material(*to.place);
    if (from.place) {
      const auto given = material(*from.place);
      if (!given || !wanted || *given == *wanted) return;
      error(fmt::format("{} holds {}, but {} takes {}", in_quotes(place(*from.place).name),
                        in_quotes(*given), in_quotes(place(*to.place).name), in_quotes(*wanted)),
            "give both places the same 'of'; only operations turn one material into another");
      return;
    }
    const auto& contents = members_[from.slot].contents;
    if (!contents || !wanted || contents->contains(*wanted)) return;
    const std::string held =
        contents->empty() ? "is empty" : "can hold only " + in_quotes(*contents->begin());
    error(fmt::format("{} {} here, but {} takes {}", role(from.slot), held,
                      in_quotes(place(*to.place).name), in_quotes(*wanted)),
          "load it first, and give the places the same 'of'");
  }

  void act(const OperateAction& operate, std::size_t slot) {
    const Operation& operation = state_.line().operations[operate.operation.index()];
    if (!state_.is_sound(Section::kOperations, operate.operation.value)) return;
    if (operation.operated_by == task_.crew[slot].worker) return;
    const std::string& kind = task_.crew[slot].role;
    if (!operation.operated_by) {
      error(fmt::format("operation {} starts by itself and cannot be operated",
                        in_quotes(operation.name)),
            fmt::format("give the operation operated_by: {}, or remove the action", kind));
      return;
    }
    const std::string& other = state_.line().worker_kinds[operation.operated_by->index()].name;
    error(fmt::format("operation {} is operated by {}, not by {}", in_quotes(operation.name),
                      in_quotes(other), role(slot)),
          fmt::format("let {} do it", in_quotes(other)));
  }

  void act(const ReleaseAction&, std::size_t slot) {
    Member& worker = members_[slot];
    if (worker.holds) members_[*worker.holds].is_held = false;
    worker.holds.reset();
    worker.gone = true;
  }

  const BuildState& state_;
  std::int32_t id_;
  const Task& task_;
  const TaskSource& source_;
  std::vector<Member> members_;
  SourceMark mark_;
};

}  // namespace

void check_tasks(const BuildState& state) {
  std::int32_t executions = 0;
  for (const Task& task : state.line().tasks) executions += task.max_running;
  if (executions > kMostExecutions) {
    state.problems.error(mark_of(state.root, "tasks"),
                         fmt::format("the tasks may run {} times at once, more than {}", executions,
                                     kMostExecutions),
                         "lower 'max_running'");
  }
  for (std::size_t i = 0; i < state.line().tasks.size(); ++i) {
    const auto id = static_cast<std::int32_t>(i);
    if (state.is_sound(Section::kTasks, id)) TaskWalk(state, id).run();
  }
}

}  // namespace linewright::loading
