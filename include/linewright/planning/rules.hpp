#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "linewright/planning/planner.hpp"

namespace linewright {

/// A dispatching rule by its name in the field.
struct Rule {
  std::string_view name;
  std::string_view summary;
};

/// The rules that make_rule_planner knows. All are derived from the line model alone. Of the tasks
/// that may be chosen each takes the first in its order; ties: the lowest task number.
///
/// Words: the *work* of a task is what its steps take when nobody waits for anybody: for each step
/// the longest of its sequences, with ways between stations that the task itself names (not the
/// first way, which depends on who does it), and transfers `until_blocked` with a full carrier (or
/// place). The *tail* of a task is the time that what it delivers needs from there to the finished
/// product: the shortest way through operations and tasks, each with its time. The *buffers* of a
/// task are the places it puts items into (or parks a carrier at).
///
/// - `fifo`: first in first out: the task that has been selectable the longest without a break, as
///   seen at decisions
/// - `spt`, `lpt`: shortest, longest processing time: the task with the least, the most work
/// - `mwkr`: most work remaining: the largest sum of work and tail
/// - `nearest`: the fewest ticks until the last of the crew is at its first station with its
/// carrier,
///   when the allocator `sap` chooses the crew
/// - `critical_ratio`: time left over work, lowest first; the time left of a task is how long its
///   emptiest buffer lasts: the items there times the shortest time in which an operation or a task
///   takes one out (a task without a buffer comes last); ties: the largest sum of work and tail
/// - `most_urgent_buffer`: the lowest share of items in its emptiest buffer (items over capacity;
/// of
///   a place without one, over the order); ties: the most work
/// - `bottleneck_first`: the shortest way of what it delivers to the bottleneck: the machine whose
///   operations take the most ticks together, each counted once; tasks that lead there no more come
///   last
[[nodiscard]] const std::vector<Rule>& dispatching_rules();

/// Null when there is no such rule. The simulator must outlive the planner.
[[nodiscard]] std::unique_ptr<Planner> make_rule_planner(std::string_view name,
                                                         const Simulator& simulator);

}  // namespace linewright
