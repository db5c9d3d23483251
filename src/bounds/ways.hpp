#pragma once

#include <vector>

#include "linewright/line/line_model.hpp"
#include "linewright/simulation/run_setup.hpp"

namespace linewright::bounds {

/// Least ticks between stations and from where people and carriers start, whatever detours are
/// made: shortest ways over any stations; where ways are planned during the run (closed zones,
/// resting on a map) straight lines.
class Ways {
 public:
  Ways(const LineModel& line, const RunSetup& setup);

  /// 0 for stations that are equal; kNever when there is no way.
  [[nodiscard]] Tick between(WorkerKindId kind, StationId from, StationId to) const {
    return ticks_[kind.index()][from.index() * stations_ + to.index()];
  }
  /// The end of the least way there of any worker of the kind, from its start: a tick.
  [[nodiscard]] Tick reach(WorkerKindId kind, StationId to) const;
  /// The same for a worker that comes to where any carrier of the kind stands ...
  [[nodiscard]] Tick reach_carrier(WorkerKindId kind, CarrierKindId carrier) const;
  /// ... and for one that has brought such a carrier to the station.
  [[nodiscard]] Tick bring_carrier(WorkerKindId kind, CarrierKindId carrier, StationId to) const;

 private:
  [[nodiscard]] Tick first(WorkerKindId kind) const;

  const LineModel& line_;
  const RunSetup& setup_;
  std::size_t stations_;
  std::vector<std::vector<Tick>> ticks_;
};

}  // namespace linewright::bounds
