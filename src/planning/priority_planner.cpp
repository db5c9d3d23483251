#include "priority_planner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string>

#include "linewright/base/diagnostic.hpp"

namespace linewright::planning {
namespace {

TaskId find_task(const LineModel& line, std::string_view word) {
  std::vector<std::string> names;
  for (const Task& task : line.tasks) names.push_back(task.name);
  std::int32_t number = 0;
  const auto parsed = std::from_chars(word.data(), word.data() + word.size(), number);
  const bool is_number = parsed.ec == std::errc() && parsed.ptr == word.data() + word.size();
  for (std::size_t t = 0; t < line.tasks.size(); ++t) {
    if (is_number ? line.tasks[t].number == number : line.tasks[t].name == word) return TaskId(t);
  }
  throw ScenarioError({}, fmt::format("priority: line '{}' has no task '{}'", line.name, word),
                      is_number ? fmt::format("tasks are numbered 1 to {}", line.tasks.size())
                                : name_hint(word, names));
}

}  // namespace

std::vector<TaskId> tasks_by_number(const LineModel& line) {
  std::vector<TaskId> order;
  for (std::size_t t = 0; t < line.tasks.size(); ++t) order.emplace_back(t);
  return order;
}

std::vector<TaskId> parse_priority(const LineModel& line, std::string_view list) {
  std::vector<TaskId> order;
  while (!list.empty()) {
    const std::size_t comma = std::min(list.find(','), list.size());
    const TaskId task = find_task(line, list.substr(0, comma));
    if (std::find(order.begin(), order.end(), task) != order.end()) {
      throw ScenarioError(
          {}, fmt::format("priority: task '{}' is listed twice", line.tasks[task.index()].name),
          "list each task once");
    }
    order.push_back(task);
    list.remove_prefix(std::min(comma + 1, list.size()));
  }
  if (order.empty()) {
    throw ScenarioError({}, "priority: the list of tasks is missing",
                        "write priority:3,1,2 with task numbers or names, first to last, or "
                        "priority:tuned for the one that linewright tune-priority found");
  }
  for (const TaskId task : tasks_by_number(line)) {
    if (std::find(order.begin(), order.end(), task) == order.end()) order.push_back(task);
  }
  return order;
}

}  // namespace linewright::planning
