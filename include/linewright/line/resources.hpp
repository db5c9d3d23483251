#pragma once

#include <optional>
#include <string>
#include <vector>

#include "linewright/base/geometry.hpp"
#include "linewright/base/id.hpp"
#include "linewright/base/tick.hpp"
#include "linewright/line/condition.hpp"

namespace linewright {

/// constant + per_order * (quantity ordered).
struct Amount {
  std::int32_t constant = 0;
  std::int32_t per_order = 0;

  [[nodiscard]] std::int64_t value(std::int32_t order) const {
    return constant + std::int64_t{per_order} * order;
  }
};

/// From when a carrier counts as standing in a berth.
enum class BerthOccupied : std::uint8_t {
  kOnArrival,     ///< from the `park` action on: the physical rule
  kOnAssignment,  ///< from the decision of the task that will park it there
};

/// A place that is a berth: a spot where one carrier stands; the tokens of the place are the items
/// in that carrier.
struct Berth {
  CarrierKindId carrier;
  BerthOccupied occupied = BerthOccupied::kOnArrival;
};

/// Holds counted material of one kind.
struct Place {
  std::string name;
  std::string of;                        ///< kind of material; empty: the place's own name
  std::optional<std::int32_t> capacity;  ///< none: unlimited; a berth has its carrier's
  Amount initial;
  std::optional<StationId> at;
  std::optional<Berth> berth;
};

/// An idle machine drives home by itself; an operation that calls it on the way adds a travel time
/// interpolated between the positions by the homing ticks still to go, rounded down.
struct Homing {
  std::int32_t home = 0;  ///< index into Machine::positions
  std::vector<Tick>
      takes;       ///< by position: ticks to get home from there; -1: does not home from there
  Tick holds = 0;  ///< the homing time that has passed counts only from this many ticks after
                   ///< the machine came to rest (before: it stands where it stood)
};

/// An exclusive resource that operations hold.
struct Machine {
  std::string name;
  std::vector<std::string> positions;  ///< empty: the machine does not move
  std::int32_t start = 0;              ///< index into positions
  std::vector<std::vector<Tick>>
      travel;  ///< travel[to][from] in ticks; -1: not given; 0 on the diagonal
  std::optional<Homing> homing;
  std::optional<StationId> at;  ///< where it is drawn
  std::vector<Point2> area_m;   ///< the floor it takes up, for pictures only: three corners at
                               ///< least, counter-clockwise; or empty
};

/// A machine that an operation takes, and how it moves. Position values index Machine::positions.
struct MachineUse {
  MachineId machine;
  std::optional<std::int32_t>
      from;  ///< the machine first travels here: adds travel[from][where it stands]
  std::optional<std::int32_t> to;  ///< where it stands at the end; none: at `from`, or unmoved
};

/// `count` tokens taken from or put into a place (a berth: the carrier standing there).
struct TokenFlow {
  PlaceId place;
  std::int32_t count = 1;
};

/// A transition of the Petri net that fires by itself as soon as it is enabled, or, with
/// `operated_by`, when a task step starts it. Firing is atomic: tokens, room for the products and
/// machines are taken at the start; products appear after the travel of its machines plus `takes`.
struct Operation {
  std::string name;
  Tick takes = 0;                ///< >= 0; takes + shortest possible travel >= 1
  std::vector<MachineUse> uses;  ///< held for the operation and its recovery
  std::vector<MachineUse>
      claims;  ///< taken at the start and kept at the end, for a later operation
  std::vector<MachineUse>
      frees;  ///< held already (claimed by an earlier one); let go at the end + recovery
  std::vector<TokenFlow> consumes;
  std::vector<TokenFlow> produces;
  Condition when;
  Tick recovery = 0;  ///< ticks that `uses` and `frees` are still held after the products are out
  std::optional<WorkerKindId> operated_by;
};

}  // namespace linewright
