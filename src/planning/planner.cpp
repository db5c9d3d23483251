#include "linewright/planning/planner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "linewright/base/diagnostic.hpp"
#include "linewright/base/random.hpp"
#include "linewright/planning/lookahead.hpp"
#include "linewright/planning/policy_planner.hpp"
#include "linewright/planning/priority_file.hpp"
#include "linewright/planning/rules.hpp"
#include "priority_planner.hpp"

namespace linewright {
namespace {

using planning::parse_priority;
using planning::PriorityPlanner;
using planning::tasks_by_number;

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

std::unique_ptr<Planner> make_priority(std::string_view list, const Simulator& simulator,
                                       const PlannerContext& context) {
  if (list != "tuned") {
    return std::make_unique<PriorityPlanner>(parse_priority(simulator.line(), list));
  }
  return std::make_unique<PriorityPlanner>(
      load_priority(simulator.line(), {.scenario_file = context.scenario_file,
                                       .scenario_hash = context.scenario_hash,
                                       .allocator = context.allocator}));
}

std::unique_ptr<Planner> make_policy(std::string_view file, const Simulator& simulator) {
  if (!file.empty()) return make_policy_planner(std::string(file), simulator);
  throw ScenarioError({}, "policy: the file is missing", "write policy:policies/NAME.safetensors");
}

}  // namespace

const std::vector<PlannerRegistry::Entry>& PlannerRegistry::entries() {
  static const std::vector<Entry> all = [] {
    std::vector<Entry> entries{
        {"random", "", "uniform over the tasks that may be chosen"},
        {"first", "", "the task with the lowest number"},
        {"priority", "1,2,8,7,...|tuned",
         "the first task of the list (numbers or names) that may be chosen; tuned: of the list "
         "that "
         "`linewright tune-priority` wrote beside the scenario"},
        {"policy", "FILE",
         "what a trained policy rates highest (a file that `linewright train` wrote)"},
        {"lookahead", "10ms|200r[,base=...,agents=free,wait=true]",
         "what comes first in the best future found within a time or a number of rollouts"},
    };
    for (const Rule& rule : dispatching_rules()) {
      entries.push_back({std::string(rule.name), "", std::string(rule.summary)});
    }
    return entries;
  }();
  return all;
}

std::unique_ptr<Planner> PlannerRegistry::make(std::string_view spec, const Simulator& simulator,
                                               const PlannerContext& context) {
  const std::size_t colon = std::min(spec.find(':'), spec.size());
  const std::string_view name = spec.substr(0, colon);
  const std::string_view rest = spec.substr(std::min(colon + 1, spec.size()));
  if (name == "priority") return make_priority(rest, simulator, context);
  if (name == "policy") return make_policy(rest, simulator);
  if (name == "lookahead") return make_lookahead_planner(simulator, parse_lookahead(rest), context);
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
  if (auto rule = make_rule_planner(name, simulator)) return rule;
  return std::make_unique<PriorityPlanner>(tasks_by_number(simulator.line()));
}

std::vector<std::string> split_planners(std::string_view list) {
  const auto begins_planner = [](std::string_view text) {
    const std::string_view name = text.substr(0, text.find_first_of(",:"));
    const auto& all = PlannerRegistry::entries();
    return std::any_of(all.begin(), all.end(),
                       [&](const PlannerRegistry::Entry& entry) { return entry.name == name; });
  };
  std::vector<std::string> planners;
  std::size_t begin = 0;
  for (std::size_t comma = list.find(','); comma != std::string_view::npos;
       comma = list.find(',', comma + 1)) {
    if (!begins_planner(list.substr(comma + 1))) continue;
    planners.emplace_back(list.substr(begin, comma - begin));
    begin = comma + 1;
  }
  planners.emplace_back(list.substr(begin));
  return planners;
}

}  // namespace linewright
