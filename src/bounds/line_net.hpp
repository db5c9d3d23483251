#pragma once

#include <optional>
#include <vector>

#include "event_net.hpp"
#include "linewright/line/line_model.hpp"
#include "linewright/line/materials.hpp"
#include "linewright/simulation/run_setup.hpp"
#include "ways.hpp"

namespace linewright::bounds {

/// Where tokens are counted: the places, and for each kind of carrier and material one pool of all
/// such items in such carriers, which stands for every berth of the kind, too.
struct Stores {
  explicit Stores(const LineModel& line);

  [[nodiscard]] int of(PlaceId place) const { return by_place[place.index()]; }
  [[nodiscard]] int pool(CarrierKindId kind, int material) const {
    return first_pool + kind.value * materials + material;
  }

  Materials names;
  std::vector<int> by_place;
  int first_pool = 0;
  int materials = 0;
  int count = 0;
};

/// What one action of a task is in the net.
struct ActionEvents {
  int begin = -1;  ///< the event after which it begins
  int end = -1;
  int item = -1;  ///< transfers: an item has been put down
  int most = 1;   ///< transfers: items in one execution
};

struct TaskEvents {
  int start = -1;  ///< the tick of the decision
  int end = -1;
  int first = -1;  ///< the first of its other events, which follow one another
  int last = -1;
  std::vector<int> step_begin;
  std::vector<std::vector<std::vector<ActionEvents>>> actions;  ///< [step][sequence][action]
};

/// A way of tokens: an operation or a transfer.
struct Flow {
  std::vector<std::pair<int, int>> takes;  ///< (store, tokens)
  std::vector<std::pair<int, int>> gives;
  Tick least = 0;  ///< ticks from the arrival of the last token taken to that of the tokens given
  std::optional<OperationId> operation;
  std::optional<TaskId> task;
  std::size_t step = 0;  ///< with `task`: which transfer
  std::size_t sequence = 0;
  std::size_t action = 0;
};

/// The line as an event net, for one setup.
struct LineNet {
  LineNet(const LineModel& model, const RunSetup& run);

  const LineModel& line;
  const RunSetup& setup;
  Stores stores;
  Ways ways;
  EventNet net;
  std::vector<int> arrivals;       ///< by store: a token has come (those of the start included)
  std::vector<int> departures;     ///< by store: one has gone (its room is free again)
  std::vector<int> parked;         ///< by place: a carrier has come to stand in the berth
  std::vector<int> tries;          ///< by operation with operated_by: a worker is ready to start it
  std::vector<int> starts;         ///< by operation
  std::vector<int> ends;           ///< by operation: products are out
  std::vector<int> freed;          ///< by operation: its recovery is over
  std::vector<int> machine_freed;  ///< by machine: what was claimed has been let go again
  std::vector<int> machine_claimed;  ///< by machine
  std::vector<TaskEvents> tasks;
  std::vector<Flow> flows;
  std::vector<std::pair<int, int>> done;  ///< all of (store, tokens ever there) that the end needs
  int columns = 1;

  /// The tick before which the run cannot end by the least times of its events.
  [[nodiscard]] Tick end_of(const Times& times) const;
  [[nodiscard]] int initial(int store) const;
};

/// Ticks that the machine needs to `target`, called `waited` ticks after it came to rest at
/// `from`.
[[nodiscard]] Tick machine_travel(const Machine& machine, std::int32_t from, std::int32_t target,
                                  Tick waited);
/// The least ticks from when it came to rest at `from` until it can be at `target`, if it is not
/// called earlier than `held` ticks after that.
[[nodiscard]] Tick least_setup(const Machine& machine, std::int32_t from, std::int32_t target,
                               Tick held);
/// Positions at which a machine can stand when nobody holds it.
[[nodiscard]] std::vector<std::int32_t> rest_positions(const LineModel& line, MachineId machine);
/// The least ticks by which the travel of its machines prolongs the operation.
[[nodiscard]] Tick least_travel(const LineModel& line, const Operation& operation);

// The parts of the construction.
void add_operations(LineNet& net);
void add_tasks(LineNet& net);
/// Rules for tokens whose way forks: every k products need as many of them, whichever way each
/// went.
void add_requirements(LineNet& net);
/// A machine that is held on by what freed another one.
void add_couplings(LineNet& net);

}  // namespace linewright::bounds
