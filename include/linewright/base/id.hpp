#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>

namespace linewright {

/// Index of one entity of a kind, distinct per `Tag`, so that a station can never be passed where a
/// task is meant. Values are 0-based positions in the model's list of that kind; "none" is
/// `std::optional<Id>`.
template <class Tag>
struct Id {
  std::int32_t value = 0;

  constexpr Id() = default;
  constexpr explicit Id(std::int32_t v) : value(v) {}
  constexpr explicit Id(std::size_t v) : value(static_cast<std::int32_t>(v)) {}

  [[nodiscard]] constexpr std::size_t index() const { return static_cast<std::size_t>(value); }
  friend constexpr auto operator<=>(Id, Id) = default;
};

using PlaceId = Id<struct PlaceTag>;
using MachineId = Id<struct MachineTag>;
using OperationId = Id<struct OperationTag>;
using StationId = Id<struct StationTag>;
using TaskId = Id<struct TaskTag>;
/// A kind of worker (human, robot, ...), not a single one.
using WorkerKindId = Id<struct WorkerKindTag>;
/// A kind of carrier (cage, ...), not a single one.
using CarrierKindId = Id<struct CarrierKindTag>;
/// A part of the floor that can be closed.
using ZoneId = Id<struct ZoneTag>;
/// One worker of a run; workers are numbered kind by kind.
using WorkerId = Id<struct WorkerTag>;
/// One carrier of a run; carriers are numbered kind by kind.
using CarrierId = Id<struct CarrierTag>;

}  // namespace linewright
