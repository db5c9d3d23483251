#include "linewright/planning/planner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <utility>

#include "linewright/base/diagnostic.hpp"
#include "linewright/base/random.hpp"
#include "linewright/planning/policy_planner.hpp"

namespace linewright {
namespace {

/// The first selectable task of a fixed order of all tasks.
class PriorityPlanner final : public Planner {
 public:
  explicit PriorityPlanner(std::vector<TaskId> order) : order_(std::move(order)) {}

  void reset(std::uint64_t /*seed*/) override {}

  Decision decide(const SimulationState& /*state*/, const Choices& choices) override {
    for (const TaskId task : order_) {
      if (choices.tasks.contains(task)) return {.task = task};
    }
    return Decision::wait();
  }

 private:
  std::vector<TaskId> order_;
};

class RandomPlanner final : public Planner {
 public:
  RandomPlanner() : random_(0) {}

  void reset(std::uint64_t seed) override { random_ = RandomStream::derive(seed, "planner"); }

  Decision decide(const SimulationState& /*state*/, const Choices& choices) override {
    std::size_t skip = random_.below(std::max<std::size_t>(1, choices.tasks.size()));
    Decision decision;
    choices.tasks.each([&](TaskId task) {
      if (skip-- == 0) decision.task = task;
    });
    return decision;
  }

 private:
  RandomStream random_;
};

std::vector<TaskId> by_number(const LineModel& line) {
  std::vector<TaskId> order;
  for (std::size_t t = 0; t < line.tasks.size(); ++t) order.emplace_back(t);
  return order;
}

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
                        "write priority:3,1,2 with task numbers or names, first to last");
  }
  for (const TaskId task : by_number(line)) {
    if (std::find(order.begin(), order.end(), task) == order.end()) order.push_back(task);
  }
  return order;
}

}  // namespace

const std::vector<PlannerRegistry::Entry>& PlannerRegistry::entries() {
  static const std::vector<Entry> all{
      {"random", "", "uniform over the selectable tasks"},
      {"first", "", "the selectable task with the lowest number"},
      {"priority", "1,2,8,7,...", "the first selectable task of the list (numbers or names)"},
      {"policy", "FILE",
       "what a trained policy rates highest (a file that `linewright train` wrote)"},
  };
  return all;
}

std::unique_ptr<Planner> PlannerRegistry::make(std::string_view spec, const Simulator& simulator,
                                               const PlannerContext& /*context*/) {
  const std::size_t colon = std::min(spec.find(':'), spec.size());
  const std::string_view name = spec.substr(0, colon);
  const std::string_view rest = spec.substr(std::min(colon + 1, spec.size()));
  if (name == "priority") {
    return std::make_unique<PriorityPlanner>(parse_priority(simulator.line(), rest));
  }
  if (name == "policy") {
    if (!rest.empty()) return make_policy_planner(std::string(rest), simulator);
    throw ScenarioError({}, "policy: the file is missing",
                        "write policy:policies/NAME.safetensors");
  }
  std::vector<std::string> names;
  for (const Entry& entry : entries()) names.push_back(entry.name);
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    throw ScenarioError({}, fmt::format("unknown planner '{}'", name), name_hint(name, names));
  }
  if (colon < spec.size()) {
    throw ScenarioError({}, fmt::format("planner '{}' takes no '{}'", name, rest),
                        fmt::format("write just {}", name));
  }
  if (name == "random") return std::make_unique<RandomPlanner>();
  return std::make_unique<PriorityPlanner>(by_number(simulator.line()));
}

}  // namespace linewright
