#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "linewright/base/id.hpp"
#include "linewright/line/condition.hpp"
#include "linewright/line/resources.hpp"
#include "linewright/line/task.hpp"
#include "linewright/line/way_finder.hpp"
#include "linewright/line/workers.hpp"

namespace linewright {

/// Something worth a line in the log under a name of its own.
struct Milestone {
  enum class Event : std::uint8_t { kOperationDone, kTaskStart, kTaskEnd, kTokenArrives };

  std::string name;
  Event event = Event::kOperationDone;
  std::int32_t index = 0;  ///< id of the operation, task or place
};

/// How many products a run has to make, and how progress and the end are read off.
struct Order {
  std::string product;
  std::int32_t quantity = 1;
  PlaceId finished_in;  ///< progress = min(1, tokens here / quantity)
  Condition done_when;  ///< default: finished_in >= order
};

/// Ticks after which a run counts as failed; may grow with the order.
struct Horizon {
  /// (largest order quantity, ticks), ascending; larger orders get the last entry's ticks.
  std::vector<std::pair<std::int32_t, Tick>> by_order;

  [[nodiscard]] Tick ticks(std::int32_t order) const;
};

/// A production line as data: a timed Petri net with people in it. Immutable once built; holds no
/// state and knows no files. Ids index the vectors below. `tasks` is ordered by Task::number.
struct LineModel {
  std::string name;
  double tick_s = 1.0;
  std::vector<WorkerKind> worker_kinds;
  std::vector<CarrierKind> carrier_kinds;
  std::vector<Station> stations;
  std::vector<TravelTable> travel;        ///< by worker kind, all zones open
  std::vector<Zone> zones;                ///< at most kMostZones; any: `ways` is there
  std::shared_ptr<const WayFinder> ways;  ///< none: the ways are measured, or straight lines
  std::vector<Place> places;
  std::vector<Machine> machines;
  std::vector<Operation> operations;  ///< file order = order of starting at equal time
  std::vector<Task> tasks;
  std::vector<Milestone> milestones;
  Order order;
  Horizon horizon;
  bool allow_wait = false;  ///< planners may decide to wait although a task is selectable
};

}  // namespace linewright
