// Every run is a solution of a joint relaxation of its setup, as far as its log tells what happened
// when: so no bound that a solver proves can be above a makespan.

#include "linewright/bounds/joint_relaxation.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>

#include "tests/support.hpp"

namespace linewright::testing {
namespace {

/// Ticks of the occurrences of a run, by the names of their nodes.
using Happened = std::map<std::string, Tick>;

Happened happened_in(const LineModel& line, const EventLog& log) {
  Happened happened;
  std::map<std::string, int> counts;
  const auto note = [&](const std::string& what, Tick tick) {
    happened[fmt::format("{} {}", what, ++counts[what])] = tick;
  };
  for (const LogEvent& event : log.events) {
    const auto id = static_cast<std::size_t>(std::max(0, event.a));
    if (event.type == LogEvent::Type::kDecision) note(line.tasks[id].name + " decided", event.tick);
    if (event.type == LogEvent::Type::kTaskEnd) note(line.tasks[id].name + " ends", event.tick);
    if (event.type == LogEvent::Type::kOperationStart)
      note(line.operations[id].name + " starts", event.tick);
    if (event.type == LogEvent::Type::kOperationEnd)
      note(line.operations[id].name + " ends", event.tick);
  }
  return happened;
}

/// Compares a run with one relaxation; `problem` says what does not fit.
class Check {
 public:
  Check(const JointRelaxation& relaxation, const Happened& happened, Tick end)
      : relaxation_(relaxation), end_(end) {
    for (const JointRelaxation::Node& node : relaxation.nodes) {
      const auto known = happened.find(node.name);
      ticks_.push_back(known == happened.end() ? std::nullopt : std::optional(known->second));
    }
  }

  std::string problem() {
    check_nodes();
    for (const JointRelaxation::Precedence& one : relaxation_.precedences) {
      const auto to = tick(one.to);
      const auto from = tick(one.from);
      if (to && from && *to < *from + one.lag) {
        add("{} at {} comes too early after {} at {}, lag {}", name(one.to), *to, name(one.from),
            *from, one.lag);
      }
    }
    for (const JointRelaxation::Resource& resource : relaxation_.resources) check(resource);
    return problem_;
  }
  [[nodiscard]] std::size_t checked() const { return checked_; }

 private:
  struct Stay {
    Tick take = 0;
    Tick free = 0;  ///< with recovery
    const JointRelaxation::Job* job = nullptr;
  };

  template <class... Values>
  void add(fmt::format_string<Values...> text, Values&&... values) {
    if (problem_.empty()) problem_ = fmt::format(text, std::forward<Values>(values)...);
  }
  [[nodiscard]] std::optional<Tick> tick(int node) const {
    return node < 0 ? std::nullopt : ticks_[static_cast<std::size_t>(node)];
  }
  [[nodiscard]] std::string name(int node) const {
    return relaxation_.nodes[static_cast<std::size_t>(node)].name;
  }

  void check_nodes() {
    for (std::size_t n = 0; n < ticks_.size(); ++n) {
      if (ticks_[n] && *ticks_[n] < relaxation_.nodes[n].least)
        add("{} at {} is before {}", relaxation_.nodes[n].name, *ticks_[n],
            relaxation_.nodes[n].least);
    }
  }

  /// From when to when the job had the resource; none where it had not, or the log does not tell.
  [[nodiscard]] std::optional<Stay> stay_of(const JointRelaxation::Resource& resource,
                                            const JointRelaxation::Job& job) const {
    const auto take =
        job.take == JointRelaxation::kAlways ? std::optional<Tick>(0) : tick(job.take);
    if (!take) return std::nullopt;
    const Tick recovery = resource.recovery[static_cast<std::size_t>(job.type)];
    if (job.free == JointRelaxation::kAlways) return Stay{*take, *take + job.hold, &job};
    // What the log has no word for cannot be told from what did not happen.
    if (job.free >= 0 && !tick(job.free)) {
      const std::string& freed = relaxation_.nodes[static_cast<std::size_t>(job.free)].name;
      if (freed.find(" ends ") == std::string::npos) return std::nullopt;
    }
    const auto free = tick(job.free);
    return Stay{*take, free ? *free + recovery : end_ + 1, &job};
  }

  void check(const JointRelaxation::Resource& resource) {
    std::vector<Stay> stays;
    for (const JointRelaxation::Job& job : resource.jobs) {
      if (const auto stay = stay_of(resource, job)) stays.push_back(*stay);
    }
    checked_ += stays.size();
    std::sort(stays.begin(), stays.end(),
              [](const Stay& a, const Stay& b) { return a.take < b.take; });
    if (resource.exclusive) check_capacity(resource, stays);
    if (resource.exclusive && resource.capacity == 1 && !resource.lag.empty())
      check_order(resource, stays);
    for (const JointRelaxation::Instant& instant : resource.instants) {
      const auto at = tick(instant.node);
      if (!at) continue;
      for (const Stay& stay : stays) {
        const bool inside = instant.before == 1 ? stay.take < *at && *at - 1 < stay.free
                                                : stay.take < *at && *at < stay.free;
        if (inside)
          add("{} at {} is within a stay of {} from {} to {}", name(instant.node), *at,
              resource.name, stay.take, stay.free);
      }
    }
  }

  void check_capacity(const JointRelaxation::Resource& resource, const std::vector<Stay>& stays) {
    for (const Stay& stay : stays) {
      const auto at_once = std::count_if(stays.begin(), stays.end(), [&](const Stay& other) {
        return other.take <= stay.take && stay.take < other.free;
      });
      if (at_once > resource.capacity)
        add("{} of {} {} at {}", at_once, resource.capacity, resource.name, stay.take);
    }
  }

  void check_order(const JointRelaxation::Resource& resource, const std::vector<Stay>& stays) {
    for (std::size_t s = 1; s < stays.size(); ++s) {
      const JointRelaxation::Job& before = *stays[s - 1].job;
      const JointRelaxation::Job& next = *stays[s].job;
      const auto free = tick(before.free);
      const auto anchor = tick(next.anchor);
      if (!free || !anchor) continue;
      const auto row = static_cast<std::size_t>(before.type);
      const auto column = static_cast<std::size_t>(next.type);
      if (*anchor < *free + resource.lag[row][column])
        add("{} is at {} too early after {}", resource.name, name(next.anchor), name(before.free));
      const auto begin = tick(next.begin);
      if (begin && *anchor < *begin + resource.way[row][column])
        add("{} is at {} too early after it set out", resource.name, name(next.anchor));
    }
  }

  const JointRelaxation& relaxation_;
  Tick end_;
  std::vector<std::optional<Tick>> ticks_;
  std::string problem_;
  std::size_t checked_ = 0;
};

class EveryRunIsASolution : public ::testing::TestWithParam<std::string> {};

TEST_P(EveryRunIsASolution, OfAJointRelaxation) {
  const Line& line = shipped_line(GetParam());
  const LineModel& model = line.simulator->line();
  std::size_t checked = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    RunOptions options;
    for (const WorkerKind& kind : model.worker_kinds)
      options.workers.emplace_back(
          std::min(kind.count.max, kind.count.min + static_cast<int>(seed % 3)));
    options.order = 1 + static_cast<int>(seed % 4);
    const LoggedRun run = run_line(line, options, seed, seed % 2 == 0 ? "first" : "random",
                                   seed % 3 == 0 ? "no_spatial" : "sap");
    if (run.state.status != RunStatus::kFinished) continue;
    const Tick end = run.state.now;
    const auto relaxations = joint_relaxations(model, run.log.setup, end + 1);
    const Happened happened = happened_in(model, run.log);
    std::string problems;
    bool fits = false;
    for (const JointRelaxation& relaxation : relaxations) {
      Check check(relaxation, happened, end);
      const std::string problem = check.problem();
      checked += check.checked();
      fits = fits || problem.empty();
      problems += problem + "\n";
    }
    EXPECT_TRUE(fits) << "seed " << seed << ", order " << run.log.setup.order << ":\n" << problems;
  }
  RecordProperty("stays", static_cast<int>(checked));
  if (GetParam() == "scenarios/duct_line.yaml") {
    EXPECT_GT(checked, 500U);
  }
}

std::vector<std::string> lines_with_relaxations() {
  std::vector<std::string> files = shipped_scenarios();
  for (const std::string& file : awkward_scenarios()) files.push_back(file);
  return files;
}

INSTANTIATE_TEST_SUITE_P(All, EveryRunIsASolution, ::testing::ValuesIn(lines_with_relaxations()),
                         [](const ::testing::TestParamInfo<std::string>& scenario) {
                           return std::filesystem::path(scenario.param).stem().string();
                         });

const JointRelaxation::Resource* find(const JointRelaxation& relaxation, const std::string& name) {
  for (const JointRelaxation::Resource& resource : relaxation.resources) {
    if (resource.name == name) return &resource;
  }
  return nullptr;
}

TEST(JointRelaxation, OfTheDuctLineHasItsResources) {
  const LineModel& model = shipped_line("scenarios/duct_line.yaml").simulator->line();
  const RunSetup setup = sample_setup(model, crew_of({2, 3}, 5), 1);
  const auto relaxations = joint_relaxations(model, setup, 700);
  ASSERT_FALSE(relaxations.empty());
  for (const JointRelaxation& relaxation : relaxations) {
    for (const auto& [name, capacity] :
         {std::pair("human", 2), std::pair("robot", 3), std::pair("cage", 3),
          std::pair("inner_gantry", 1), std::pair("outer_gantry", 1),
          std::pair("welder.inner", 1)}) {
      const JointRelaxation::Resource* resource = find(relaxation, name);
      ASSERT_NE(resource, nullptr) << name;
      EXPECT_EQ(resource->capacity, capacity) << name;
    }
    EXPECT_EQ(find(relaxation, "human")->first_way.size(), 2U);
    EXPECT_FALSE(find(relaxation, "inner_gantry")->lag.empty());
    EXPECT_FALSE(find(relaxation, "no carrier in outfeed_berth")->instants.empty());
    ASSERT_EQ(relaxation.batches.size(), 5U);  // two loadings, two unloadings, and the storing
    EXPECT_TRUE(relaxation.batches[0].full);
    EXPECT_EQ(relaxation.batches[1].loaded_by, 0);
    EXPECT_FALSE(relaxation.batches[4].before_decision.empty());
  }
}

TEST(JointRelaxation, ThereIsNoneBelowTheCriticalPath) {
  const LineModel& model = shipped_line("scenarios/duct_line.yaml").simulator->line();
  const RunSetup setup = sample_setup(model, crew_of({3, 3}, 5), 1);
  EXPECT_TRUE(joint_relaxations(model, setup, 600).empty());
}

}  // namespace
}  // namespace linewright::testing
