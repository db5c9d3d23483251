#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "build_state.hpp"
#include "linewright/scenario/values.hpp"
#include "machine_motion.hpp"
#include "task_actions.hpp"

namespace linewright::loading {
namespace {

using UseList = std::vector<MachineUse> Operation::*;

bool mentions(const Operation& operation, UseList list, MachineId machine) {
  const auto& uses = operation.*list;
  return std::any_of(uses.begin(), uses.end(),
                     [&](const MachineUse& use) { return use.machine == machine; });
}

/// The first operation that has the machine in `list`.
std::optional<std::size_t> first_with(const LineModel& line, UseList list, MachineId machine) {
  for (std::size_t i = 0; i < line.operations.size(); ++i) {
    if (mentions(line.operations[i], list, machine)) return i;
  }
  return std::nullopt;
}

void check_claims(const BuildState& state, MachineId machine) {
  const LineModel& line = state.line();
  const auto claimed = first_with(line, &Operation::claims, machine);
  const auto freed = first_with(line, &Operation::frees, machine);
  if (claimed.has_value() == freed.has_value()) return;
  const std::size_t operation = claimed ? *claimed : *freed;
  const std::string title =
      state.names.title(Section::kOperations, static_cast<std::int32_t>(operation));
  const std::string name = in_quotes(line.machines[machine.index()].name);
  const SourceMark mark =
      mark_of(state.names.node(Section::kOperations, static_cast<std::int32_t>(operation)),
              claimed ? "claims" : "frees");
  if (claimed) {
    state.problems.error(
        mark, fmt::format("{} claims machine {}, but no operation frees it", title, name),
        "list it under 'uses', or under 'frees' of the operation that lets it go");
  } else {
    state.problems.error(
        mark, fmt::format("{} frees machine {}, but no operation claims it", title, name),
        "list it under 'uses', or under 'claims' of the operation that takes it");
  }
}

/// Checks what one operation asks of its machines, and how long it lasts at least.
class OperationCheck {
 public:
  OperationCheck(const BuildState& state, std::int32_t id,
                 const std::vector<MachineMotion>& motions)
      : state_(state),
        id_(id),
        operation_(state.line().operations[static_cast<std::size_t>(id)]),
        motions_(motions) {}

  void run() {
    if (starts_for_ever()) {
      state_.problems.error(
          mark(), title() + " waits for nothing: it would start again and again in one tick",
          "let it consume something, use a machine, or produce into a place with a capacity");
    }
    for (const MachineUse& use : operation_.uses) add_travel(use, idle_starts(use));
    for (const MachineUse& use : operation_.claims) add_travel(use, idle_starts(use));
    for (const MachineUse& use : operation_.frees)
      add_travel(use, motions_[use.machine.index()].held);
    if (!travel_known_ || operation_.takes + least_travel_ >= 1) return;
    const char* hint = moves_ ? "write takes: N; the machine may stand there already"
                              : "write takes: N with N of at least 1";
    state_.problems.error(mark(), title() + " takes no time", hint);
  }

 private:
  /// Nothing that a start takes away could keep the next one from happening.
  [[nodiscard]] bool starts_for_ever() const {
    if (operation_.operated_by || !operation_.consumes.empty() || !operation_.uses.empty() ||
        !operation_.claims.empty() || !operation_.frees.empty()) {
      return false;
    }
    return std::none_of(operation_.produces.begin(), operation_.produces.end(),
                        [&](const TokenFlow& flow) {
                          const Place& place = state_.line().places[flow.place.index()];
                          return place.capacity.has_value() || place.berth.has_value();
                        });
  }

  [[nodiscard]] std::string title() const { return state_.names.title(Section::kOperations, id_); }
  [[nodiscard]] SourceMark mark() const { return state_.names.mark(Section::kOperations, id_); }

  [[nodiscard]] std::vector<bool> idle_starts(const MachineUse& use) const {
    return called_from(state_.line().machines[use.machine.index()], motions_[use.machine.index()]);
  }

  void add_travel(const MachineUse& use, const std::vector<bool>& starts) {
    if (!use.from) return;
    moves_ = true;
    const Machine& machine = state_.line().machines[use.machine.index()];
    const auto& ticks_from = machine.travel[static_cast<std::size_t>(*use.from)];
    Tick least = kMaxTicks;
    for (std::size_t i = 0; i < starts.size(); ++i) {
      if (!starts[i]) continue;
      if (ticks_from[i] < 0) report_missing(machine, *use.from, i);
      least = std::min(least, ticks_from[i]);
    }
    least_travel_ = std::max(least_travel_, least);
  }

  void report_missing(const Machine& machine, std::int32_t to, std::size_t from) {
    travel_known_ = false;
    const std::string& target = machine.positions[static_cast<std::size_t>(to)];
    state_.problems.error(
        mark(),
        fmt::format("{}: machine {} may stand at {}, from where no travel to {} is given", title(),
                    in_quotes(machine.name), in_quotes(machine.positions[from]), in_quotes(target)),
        fmt::format("write travel: {{{}: {{{}: ticks}}}}", target, machine.positions[from]));
  }

  const BuildState& state_;
  std::int32_t id_;
  const Operation& operation_;
  const std::vector<MachineMotion>& motions_;
  Tick least_travel_ = 0;
  bool travel_known_ = true;
  bool moves_ = false;
};

std::optional<std::int32_t> capacity_of(const LineModel& line, const Place& place) {
  if (place.berth) return line.carrier_kinds[place.berth->carrier.index()].capacity;
  return place.capacity;
}

/// More tokens at once than the place can hold can never lie there.
void check_amounts(const BuildState& state, std::int32_t id, const char* key,
                   const std::vector<TokenFlow>& flows) {
  for (const TokenFlow& flow : flows) {
    const Place& place = state.line().places[flow.place.index()];
    const auto capacity = capacity_of(state.line(), place);
    if (!capacity || flow.count <= *capacity) continue;
    state.problems.error(mark_of(state.names.node(Section::kOperations, id), key),
                         fmt::format("{} {} {} tokens of place {}, which holds at most {}",
                                     state.names.title(Section::kOperations, id), key, flow.count,
                                     in_quotes(place.name), *capacity),
                         "it could never start");
  }
}

/// Two positions with one homing time would leave open from where a way home is interpolated.
void check_homing(const BuildState& state, std::int32_t id) {
  const Machine& machine = state.line().machines[static_cast<std::size_t>(id)];
  if (!machine.homing || !state.is_sound(Section::kMachines, id)) return;
  const auto& takes = machine.homing->takes;
  for (std::size_t a = 0; a < takes.size(); ++a) {
    for (std::size_t b = a + 1; b < takes.size(); ++b) {
      if (takes[a] < 0 || takes[a] != takes[b]) continue;
      const auto differs = [&](const std::vector<Tick>& row) { return row[a] != row[b]; };
      if (std::none_of(machine.travel.begin(), machine.travel.end(), differs)) continue;
      state.problems.error(
          mark_of(state.names.node(Section::kMachines, id), "homing"),
          fmt::format("{}: {} and {} have the same homing time, but different travel times",
                      state.names.title(Section::kMachines, id), in_quotes(machine.positions[a]),
                      in_quotes(machine.positions[b])),
          "a machine on its way home is where its homing time left says; make the times differ");
    }
  }
}

std::set<std::int32_t> operated_by_tasks(const LineModel& line) {
  std::set<std::int32_t> operated;
  for (const Task& task : line.tasks) {
    for_each_action_of<OperateAction>(
        task, [&](const OperateAction& operate) { operated.insert(operate.operation.value); });
  }
  return operated;
}

void check_operated(const BuildState& state) {
  if (!state.all_sound(Section::kTasks)) return;
  const std::set<std::int32_t> operated = operated_by_tasks(state.line());
  for (std::size_t i = 0; i < state.line().operations.size(); ++i) {
    const auto id = static_cast<std::int32_t>(i);
    if (!state.line().operations[i].operated_by || operated.contains(id)) continue;
    state.problems.error(
        mark_of(state.names.node(Section::kOperations, id), "operated_by"),
        fmt::format("{} never starts: no task operates it",
                    state.names.title(Section::kOperations, id)),
        fmt::format("add an action {{operate: {}}} to a task, or remove 'operated_by'",
                    state.line().operations[i].name));
  }
}

}  // namespace

void check_machines(const BuildState& state) {
  for (std::size_t i = 0; i < state.line().machines.size(); ++i) {
    check_homing(state, static_cast<std::int32_t>(i));
  }
  if (!state.all_sound(Section::kMachines) || !state.all_sound(Section::kOperations)) return;
  for (std::size_t i = 0; i < state.line().machines.size(); ++i) check_claims(state, MachineId(i));
}

void check_operations(const BuildState& state) {
  check_operated(state);
  if (!state.all_sound(Section::kPlaces) || !state.all_sound(Section::kMachines)) return;
  const bool motions_known = state.all_sound(Section::kOperations);
  std::vector<MachineMotion> motions;
  for (std::size_t i = 0; motions_known && i < state.line().machines.size(); ++i) {
    motions.push_back(machine_motion(state.line(), MachineId(i)));
  }
  for (std::size_t i = 0; i < state.line().operations.size(); ++i) {
    const auto id = static_cast<std::int32_t>(i);
    if (!state.is_sound(Section::kOperations, id)) continue;
    const Operation& operation = state.line().operations[i];
    check_amounts(state, id, "consumes", operation.consumes);
    check_amounts(state, id, "produces", operation.produces);
    if (motions_known) OperationCheck(state, id, motions).run();
  }
}

}  // namespace linewright::loading
