#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "linewright/base/id.hpp"
#include "linewright/base/tick.hpp"
#include "linewright/line/condition.hpp"

namespace linewright {

/// Which carrier a task wants.
enum class CarrierWanted : std::uint8_t {
  kEmpty,  ///< a free one with nothing in it
  kAny,    ///< any free one
  kBerth,  ///< the one that stands in a given berth
};

/// One member of a task's crew: a worker or a carrier. A crew `human: 2` is two slots named
/// `human`.
struct CrewSlot {
  std::string role;                    ///< the name steps address it by
  std::optional<WorkerKindId> worker;  ///< exactly one of worker and carrier is set
  std::optional<CarrierKindId> carrier;
  bool join_late = false;  ///< workers: the task may start without it; it is bound as soon as
                           ///< one is free
  CarrierWanted wanted = CarrierWanted::kEmpty;
  PlaceId berth;  ///< for CarrierWanted::kBerth
};

/// Where an item is taken from or put: a place, or the task's carrier in crew slot `slot`.
struct Endpoint {
  std::optional<PlaceId> place;
  std::size_t slot = 0;  ///< when place is none
};

/// The worker walks or drives to a station (with the carrier it holds).
struct GoAction {
  StationId station;
};
/// The worker goes to where the carrier stands and takes it along.
struct FetchAction {
  std::size_t carrier_slot = 0;
};
/// The worker puts its carrier down: into a berth, or where it is (`berth` none). A carrier parked
/// in a berth leaves the task and stays there until a task asks for it by that berth.
struct ParkAction {
  std::size_t carrier_slot = 0;
  std::optional<PlaceId> berth;
};
/// The worker moves items one by one, `takes` ticks each. An item counts at its source until it has
/// been put down; item and room are reserved when it is picked up.
struct TransferAction {
  Endpoint source;
  Endpoint destination;
  Tick takes = 1;           ///< >= 1, per item
  std::int32_t repeat = 1;  ///< items; waits for each to become possible. kUntilBlocked: as many as
                            ///< are possible without waiting, maybe none
  static constexpr std::int32_t kUntilBlocked = 0;
};
/// The worker starts an operation with `operated_by` and stays until its products are out; waits
/// while the operation is not enabled.
struct OperateAction {
  OperationId operation;
};
/// The worker leaves the task and is free for another.
struct ReleaseAction {};

/// One action of one crew member, with ticks of preparation before and of settling after it.
struct Action {
  std::variant<GoAction, FetchAction, ParkAction, TransferAction, OperateAction, ReleaseAction>
      what;
  Tick before = 0;
  Tick after = 0;
};

/// What one crew member does within a step, one action after the other.
struct ActorSequence {
  std::size_t slot = 0;
  std::vector<Action> actions;
};

/// One line of a task: a rendezvous. All its sequences start together and run in parallel; the next
/// step starts in the tick in which the last of them ends.
struct Step {
  std::vector<ActorSequence> sequences;  ///< in crew order
};

/// A token or room that a task reserves at the decision, so that no other can take it meanwhile.
/// The task's own transfers use it first; what is left is given back when the task ends.
struct Reservation {
  PlaceId place;
  bool room = false;  ///< room for one token instead of one token
};

/// What the planner may choose.
struct Task {
  std::string name;
  std::int32_t number = 0;  ///< 1-based, unique; the order of tasks in the model and in `first`
  std::vector<CrewSlot> crew;
  Condition when;
  std::vector<Reservation> reserves;
  std::int32_t max_running = 1;
  std::vector<Step> steps;
};

}  // namespace linewright
