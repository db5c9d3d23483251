#include <fmt/format.h>

#include "compiled_line.hpp"
#include "linewright/simulation/simulator.hpp"

namespace linewright {
namespace {

/// What the user calls the variable, as in a condition.
std::string name_of(const CompiledLine& compiled, std::int32_t variable) {
  const ValueLayout& layout = compiled.layout;
  const LineModel& line = compiled.line;
  const auto at = [](std::int32_t id) { return static_cast<std::size_t>(id); };
  if (variable < layout.berths) {
    static constexpr const char* kSuffix[] = {"", ".available", ".room", ".occupied"};
    return line.places[at(variable / 4)].name + kSuffix[variable % 4];
  }
  if (variable < layout.machines) {
    const std::int32_t local = variable - layout.berths;
    return fmt::format("{} ({})", line.places[at(local / 2)].name,
                       local % 2 == ValueLayout::kBerthOpen ? "berth neither occupied nor promised"
                                                            : "carrier standing there and ready");
  }
  if (variable < layout.operations) {
    static constexpr const char* kSuffix[] = {".free", ".working", ".held"};
    const std::int32_t local = variable - layout.machines;
    return line.machines[at(local / 3)].name + kSuffix[local % 3];
  }
  if (variable < layout.tasks) {
    const std::int32_t local = variable - layout.operations;
    return line.operations[at(local / 2)].name + (local % 2 == 0 ? ".running" : ".done");
  }
  if (variable < layout.workers) {
    const std::int32_t local = variable - layout.tasks;
    return line.tasks[at(local / 2)].name + (local % 2 == 0 ? ".running" : ".done");
  }
  if (variable < layout.carriers)
    return line.worker_kinds[at(variable - layout.workers)].name + ".free";
  if (variable < layout.order) {
    const std::int32_t local = variable - layout.carriers;
    return line.carrier_kinds[at(local / 2)].name + (local % 2 == 0 ? ".free" : ".free and empty");
  }
  return "order";
}

std::string describe(const CompiledLine& compiled, const RangeCheck& check, std::int32_t value) {
  const std::string name = name_of(compiled, check.variable);
  if (value < check.low) return fmt::format("{} is {}, needs {}", name, value, check.low);
  return fmt::format("{} is {}, may be at most {}", name, value, check.high);
}

}  // namespace

std::string Simulator::explain_unselectable(const SimulationState& state, TaskId task) const {
  const CompiledCondition& condition = compiled_->tasks[task.index()].selectable;
  for (const RangeCheck& check : condition.checks) {
    const std::int32_t value = state.values[static_cast<std::size_t>(check.variable)];
    if (value < check.low || value > check.high) return describe(*compiled_, check, value);
  }
  if (!condition.holds(state.values)) return "when: " + line_->tasks[task.index()].when.text;
  return {};
}

std::string Simulator::explain_refusal(const SimulationState& state,
                                       const Assignment& assignment) const {
  if (can_assign(state, assignment)) return {};
  if (state.ended()) return "the run has ended";
  if (state.now >= state.horizon) return "the horizon has been reached";
  if (assignment.task.value < 0 || assignment.task.index() >= line_->tasks.size()) {
    return fmt::format("the line has no task {}", assignment.task.value);
  }
  const Task& task = line_->tasks[assignment.task.index()];
  const std::string unselectable = explain_unselectable(state, assignment.task);
  if (!unselectable.empty())
    return fmt::format("{} is not selectable: {}", task.name, unselectable);
  for (std::size_t i = 0; i < task.crew.size(); ++i) {
    const CrewSlot& slot = task.crew[i];
    const std::int16_t member = assignment.members[i];
    if (slot.worker && member < 0 && slot.join_late) continue;
    if (member < 0) return fmt::format("{} needs a {}", task.name, slot.role);
    const auto index = static_cast<std::size_t>(member);
    if (slot.worker) {
      const bool fits = index < state.workers.size() && state.workers[index].free() &&
                        state.workers[index].kind == slot.worker->value;
      if (!fits) return fmt::format("worker {} is no free {}", member, slot.role);
    } else if (!carrier_fits(state, slot, CarrierId(std::int32_t{member}))) {
      return fmt::format("carrier {} is not a {} that {} may take now", member, slot.role,
                         task.name);
    }
  }
  return fmt::format("{} names one member twice", task.name);
}

}  // namespace linewright
