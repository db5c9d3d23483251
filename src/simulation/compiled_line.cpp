#include "compiled_line.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <string>
#include <variant>

#include "linewright/line/materials.hpp"

namespace linewright {
namespace {

bool holds(const CompiledCondition::Comparison& comparison,
           const std::vector<std::int32_t>& values) {
  std::int64_t sum = comparison.constant;
  for (const auto& [variable, coefficient] : comparison.terms) {
    sum += std::int64_t{coefficient} * values[static_cast<std::size_t>(variable)];
  }
  return relation_holds(sum, comparison.relation);
}

/// variable * 1 + constant RELATION 0 as a range of the variable; false when it is none.
bool as_range(const CompiledCondition::Comparison& comparison, RangeCheck& range) {
  if (comparison.terms.size() != 1 || comparison.terms[0].second != 1) return false;
  range = RangeCheck{.variable = comparison.terms[0].first};
  const std::int32_t bound = -comparison.constant;
  switch (comparison.relation) {
    case Relation::kEqual:
      range.low = range.high = bound;
      return true;
    case Relation::kNotEqual:
      return false;
    case Relation::kLess:
      range.high = bound - 1;
      return true;
    case Relation::kLessEqual:
      range.high = bound;
      return true;
    case Relation::kGreater:
      range.low = bound + 1;
      return true;
    case Relation::kGreaterEqual:
      range.low = bound;
      return true;
  }
  return false;
}

void require(CompiledCondition& condition, std::int32_t variable, std::int32_t low) {
  condition.checks.push_back({.variable = variable, .low = low});
}

/// The checks of several flows, those of one place added up.
void require_flows(CompiledCondition& condition, const std::vector<TokenFlow>& flows,
                   std::int32_t what) {
  std::map<std::int32_t, std::int32_t> total;
  for (const TokenFlow& flow : flows) total[flow.place.value] += flow.count;
  for (const auto& [place, count] : total)
    require(condition, ValueLayout::place(place, what), count);
}

template <class T>
std::size_t words_for(const std::vector<T>& entries, std::size_t extra = 0) {
  return (entries.size() + extra + 63) / 64 + (entries.size() + extra == 0 ? 1 : 0);
}

}  // namespace

bool CompiledCondition::holds(const std::vector<std::int32_t>& values) const {
  for (const RangeCheck& check : checks) {
    const std::int32_t value = values[static_cast<std::size_t>(check.variable)];
    if (value < check.low || value > check.high) return false;
  }
  if (rest.empty()) return true;
  return std::any_of(rest.begin(), rest.end(), [&](const auto& clause) {
    return std::all_of(clause.begin(), clause.end(),
                       [&](const Comparison& c) { return linewright::holds(c, values); });
  });
}

std::vector<std::int32_t> CompiledCondition::variables() const {
  std::vector<std::int32_t> read;
  for (const RangeCheck& check : checks) read.push_back(check.variable);
  for (const auto& clause : rest) {
    for (const Comparison& comparison : clause) {
      for (const auto& term : comparison.terms) read.push_back(term.first);
    }
  }
  return read;
}

std::int32_t ValueLayout::index(Variable variable) const {
  const std::int32_t id = variable.index;
  switch (variable.kind) {
    case VariableKind::kPlaceCount:
      return place(id, kCount);
    case VariableKind::kPlaceAvailable:
      return place(id, kAvailable);
    case VariableKind::kPlaceRoom:
      return place(id, kRoom);
    case VariableKind::kPlaceOccupied:
      return place(id, kOccupied);
    case VariableKind::kMachineFree:
      return machine(id, kFree);
    case VariableKind::kMachineWorking:
      return machine(id, kWorking);
    case VariableKind::kOperationRunning:
      return operation_running(id);
    case VariableKind::kOperationDone:
      return operation_running(id) + 1;
    case VariableKind::kTaskRunning:
      return task_running(id);
    case VariableKind::kTaskDone:
      return task_running(id) + 1;
    case VariableKind::kWorkersFree:
      return worker_free(id);
    case VariableKind::kCarriersFree:
      return carrier(id, kFreeCarriers);
    case VariableKind::kOrder:
      return order;
  }
  return order;
}

CompiledLine::CompiledLine(const LineModel& model) : line(model) {
  lay_out();
  compile_operations();
  compile_tasks();
  compile_machines();
  done = compile(line.order.done_when);
  index_readers();
  index_milestones();
}

void CompiledLine::lay_out() {
  const auto size_of = [](const auto& list) { return static_cast<std::int32_t>(list.size()); };
  layout.berths = size_of(line.places) * 4;
  layout.machines = layout.berths + size_of(line.places) * 2;
  layout.operations = layout.machines + size_of(line.machines) * 3;
  layout.tasks = layout.operations + size_of(line.operations) * 2;
  layout.workers = layout.tasks + size_of(line.tasks) * 2;
  layout.carriers = layout.workers + size_of(line.worker_kinds);
  layout.order = layout.carriers + size_of(line.carrier_kinds) * 2;
  layout.size = layout.order + 1;

  place_material = materials_of(line).by_place;
  has_side_events =
      !line.zones.empty() || std::any_of(line.worker_kinds.begin(), line.worker_kinds.end(),
                                         [](const WorkerKind& kind) { return !kind.rest.empty(); });
  for (const Task& task : line.tasks) most_executions += static_cast<std::size_t>(task.max_running);
}

CompiledCondition CompiledLine::compile(const Condition& condition) const {
  CompiledCondition compiled;
  for (const auto& clause : condition.any_of) {
    auto& target = compiled.rest.emplace_back();
    for (const Comparison& comparison : clause) {
      CompiledCondition::Comparison made{
          .terms = {}, .constant = comparison.constant, .relation = comparison.relation};
      for (const Term& term : comparison.terms) {
        made.terms.emplace_back(layout.index(term.variable), term.coefficient);
      }
      target.push_back(std::move(made));
    }
  }
  if (compiled.rest.size() != 1) return compiled;
  // A single clause is a plain conjunction: what is a range of one variable becomes a check.
  std::erase_if(compiled.rest[0], [&](const CompiledCondition::Comparison& comparison) {
    RangeCheck range;
    if (!as_range(comparison, range)) return false;
    compiled.checks.push_back(range);
    return true;
  });
  if (compiled.rest[0].empty()) compiled.rest.clear();
  return compiled;
}

void CompiledLine::compile_operations() {
  for (const Operation& operation : line.operations) {
    CompiledOperation made{.enabled = compile(operation.when),
                           .by_worker = operation.operated_by.has_value()};
    require_flows(made.enabled, operation.consumes, ValueLayout::kAvailable);
    require_flows(made.enabled, operation.produces, ValueLayout::kRoom);
    for (const auto* taken : {&operation.uses, &operation.claims}) {
      for (const MachineUse& use : *taken) {
        require(made.enabled, layout.machine(use.machine.value, ValueLayout::kFree), 1);
      }
    }
    for (const MachineUse& use : operation.frees) {
      require(made.enabled, layout.machine(use.machine.value, ValueLayout::kHeld), 1);
    }
    operations.push_back(std::move(made));
  }
}

void CompiledLine::compile_tasks() {
  for (std::size_t t = 0; t < line.tasks.size(); ++t) {
    const Task& task = line.tasks[t];
    CompiledTask made{.selectable = compile(task.when), .park_berths = {}, .sequence_of = {}};
    made.selectable.checks.push_back({.variable = layout.task_running(static_cast<std::int32_t>(t)),
                                      .low = 0,
                                      .high = task.max_running - 1});
    std::map<std::int32_t, std::int32_t> needed;
    for (const CrewSlot& slot : task.crew) {
      if (slot.worker && !slot.join_late) ++needed[layout.worker_free(slot.worker->value)];
      if (!slot.carrier) continue;
      if (slot.wanted == CarrierWanted::kBerth) {
        needed[layout.berth(slot.berth.value, ValueLayout::kBerthReady)] = 1;
      } else {
        const bool empty = slot.wanted == CarrierWanted::kEmpty;
        ++needed[layout.carrier(slot.carrier->value, empty ? ValueLayout::kFreeEmptyCarriers
                                                           : ValueLayout::kFreeCarriers)];
      }
    }
    for (const Reservation& reservation : task.reserves) {
      ++needed[ValueLayout::place(reservation.place.value,
                                  reservation.room ? ValueLayout::kRoom : ValueLayout::kAvailable)];
    }
    for (const Step& step : task.steps) {
      auto& sequences = made.sequence_of.emplace_back(task.crew.size(), std::int16_t{-1});
      for (std::size_t s = 0; s < step.sequences.size(); ++s) {
        sequences[step.sequences[s].slot] = static_cast<std::int16_t>(s);
        for (const Action& action : step.sequences[s].actions) {
          const auto* park = std::get_if<ParkAction>(&action.what);
          if (park == nullptr || !park->berth) continue;
          made.park_berths.push_back(park->berth->value);
          needed[layout.berth(park->berth->value, ValueLayout::kBerthOpen)] = 1;
        }
      }
    }
    for (const auto& [variable, low] : needed) require(made.selectable, variable, low);
    tasks.push_back(std::move(made));
  }
}

void CompiledLine::compile_machines() {
  for (const Machine& machine : line.machines) {
    CompiledMachine& made = machines.emplace_back();
    if (!machine.homing) continue;
    made.homing_points.emplace_back(0, machine.homing->home);
    for (std::size_t p = 0; p < machine.positions.size(); ++p) {
      const Tick takes = machine.homing->takes[p];
      if (takes > 0) made.homing_points.emplace_back(takes, static_cast<std::int32_t>(p));
    }
    std::sort(made.homing_points.begin(), made.homing_points.end());
  }
}

Tick CompiledLine::travel(MachineId id, std::int32_t target, const MachineState& state,
                          Tick now) const {
  const Machine& machine = line.machines[id.index()];
  const auto& travel_to = machine.travel[static_cast<std::size_t>(target)];
  const auto from = static_cast<std::size_t>(state.position);
  const Tick standing = std::max(0, travel_to[from]);
  if (!machine.homing || machine.homing->takes[from] <= 0) return standing;

  const Tick passed = now - state.rest_since;
  if (passed < machine.homing->holds) return standing;
  const Tick to_go = std::max(0, machine.homing->takes[from] - passed);
  const auto& points = machines[id.index()].homing_points;
  const auto upper = std::find_if(points.begin(), points.end(),
                                  [&](const auto& point) { return point.first >= to_go; });
  const std::int64_t at_upper = travel_to[static_cast<std::size_t>(upper->second)];
  if (upper->first == to_go || at_upper < 0)
    return static_cast<Tick>(std::max<std::int64_t>(0, at_upper));
  const auto lower = std::prev(upper);
  const std::int64_t at_lower = travel_to[static_cast<std::size_t>(lower->second)];
  if (at_lower < 0) return standing;
  const std::int64_t span = upper->first - lower->first;
  const std::int64_t weight = to_go - lower->first;
  return static_cast<Tick>((at_lower * (span - weight) + at_upper * weight) / span);
}

void CompiledLine::index_readers() {
  operation_words = words_for(operations);
  task_words = words_for(tasks, 1);
  const auto variables = static_cast<std::size_t>(layout.size);
  operations_reading.assign(variables * operation_words, 0);
  tasks_reading.assign(variables * task_words, 0);
  const auto mark = [](std::vector<std::uint64_t>& sets, std::size_t words, std::size_t bit,
                       const CompiledCondition& condition) {
    for (const std::int32_t variable : condition.variables()) {
      sets[static_cast<std::size_t>(variable) * words + bit / 64] |= std::uint64_t{1} << (bit % 64);
    }
  };
  for (std::size_t o = 0; o < operations.size(); ++o) {
    if (!operations[o].by_worker)
      mark(operations_reading, operation_words, o, operations[o].enabled);
  }
  for (std::size_t t = 0; t < tasks.size(); ++t)
    mark(tasks_reading, task_words, t, tasks[t].selectable);
  mark(tasks_reading, task_words, done_bit(), done);

  matters.assign(variables, true);
  const auto forget_unread = [&](std::int32_t first, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
      matters[static_cast<std::size_t>(first) + i * 2 + 1] = false;
  };
  forget_unread(layout.operations, operations.size());
  forget_unread(layout.tasks, tasks.size());
  const auto remember = [&](const CompiledCondition& condition) {
    for (const std::int32_t variable : condition.variables())
      matters[static_cast<std::size_t>(variable)] = true;
  };
  for (const CompiledOperation& operation : operations) remember(operation.enabled);
  for (const CompiledTask& task : tasks) remember(task.selectable);
  remember(done);
}

void CompiledLine::index_milestones() {
  operation_milestones.resize(operations.size());
  task_start_milestones.resize(tasks.size());
  task_end_milestones.resize(tasks.size());
  place_milestones.resize(line.places.size());
  for (std::size_t m = 0; m < line.milestones.size(); ++m) {
    const Milestone& milestone = line.milestones[m];
    const auto at = static_cast<std::size_t>(milestone.index);
    const auto id = static_cast<std::int32_t>(m);
    switch (milestone.event) {
      case Milestone::Event::kOperationDone:
        operation_milestones[at].push_back(id);
        break;
      case Milestone::Event::kTaskStart:
        task_start_milestones[at].push_back(id);
        break;
      case Milestone::Event::kTaskEnd:
        task_end_milestones[at].push_back(id);
        break;
      case Milestone::Event::kTokenArrives:
        place_milestones[at].push_back(id);
        break;
    }
  }
}

}  // namespace linewright
