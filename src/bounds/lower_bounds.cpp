#include "linewright/bounds/lower_bounds.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cases.hpp"
#include "explain_path.hpp"
#include "line_net.hpp"
#include "sequence.hpp"

namespace linewright {
namespace {

using bounds::Case;

/// All bounds of one setup, case by case.
class Report {
 public:
  Report(const LineModel& line, const RunSetup& setup, const BoundOptions& options,
         const CancelToken* cancel)
      : line_(line),
        setup_(setup),
        options_(options),
        cancel_(cancel),
        net_(line, setup),
        cases_(bounds::cases_of(net_, net_.net.solve(net_.columns))),
        best_(cases_.size()) {
    for (std::size_t c = 0; c < cases_.size(); ++c) best_[c] = cases_[c].ends;
  }

  std::vector<Bound> make() {
    add("critical_path", cases_[0].ends, critical_path_text());
    if (cases_[0].ends < bounds::kNever) {
      for (std::size_t k = 0; k < line_.worker_kinds.size(); ++k) add_workload(WorkerKindId(k));
      for (std::size_t m = 0; m < line_.machines.size(); ++m) add_machine(MachineId(m));
      for (std::size_t k = 0; k < line_.worker_kinds.size(); ++k) add_worker(WorkerKindId(k));
      add_combined();
    }
    std::stable_sort(bounds_.begin(), bounds_.end(),
                     [](const Bound& a, const Bound& b) { return a.ticks > b.ticks; });
    return std::move(bounds_);
  }

 private:
  void add(std::string name, Tick ticks, std::string argument) {
    bounds_.push_back(
        {std::move(name), std::clamp(ticks, Tick{1}, kMaxTicks), std::move(argument)});
  }

  [[nodiscard]] std::string ordered() const {
    return fmt::format("{} {}", setup_.order, line_.order.product);
  }

  [[nodiscard]] std::string critical_path_text() const {
    if (cases_[0].ends >= bounds::kNever)
      return fmt::format("This crew can never finish {}: something that it needs never comes.",
                         ordered());
    std::string text =
        "If nobody and nothing had to wait for a person, robot or machine that another job has, "
        "each of these could come right after the one before: " +
        bounds::path_text(net_, cases_[0].times) + ".";
    if (cases_.size() > 1) {
      text += fmt::format(
          " All {} ways to share the tokens of the line's forks were tried; this "
          "is the earliest.",
          cases_.size());
    }
    return text;
  }

  /// The least over the cases of what the jobs of one resource allow.
  Tick sequenced(const bounds::SequenceProblem& problem, std::size_t& states) {
    Tick least = kMaxTicks;
    for (std::size_t c = 0; c < cases_.size(); ++c) {
      if (cases_[c].ends >= least) break;
      const auto found = bounds::best_sequence(net_, cases_[c].times, problem, least,
                                               options_.most_states, cancel_);
      states += found.states;
      const Tick here = std::max(cases_[c].ends, found.ticks);
      best_[c] = std::max(best_[c], here);
      least = std::min(least, here);
    }
    return least;
  }

  void add_workload(WorkerKindId kind) {
    const auto problem = bounds::worker_problem(net_, kind);
    if (!problem || cancelled()) return;
    const bounds::Workload work = bounds::workload_of(net_, cases_[0].times, *problem, cancel_);
    const auto workers = static_cast<Tick>(setup_.worker_start[kind.index()].size());
    const Tick ticks = (work.ticks + workers - 1) / workers - work.rest;
    const std::string& name = line_.worker_kinds[kind.index()].name;
    add("workload:" + name, ticks,
        fmt::format("{} need at least {} ticks of work by a {} (without the ways between jobs), "
                    "shared by {}; at most {} of each one's share can lie after the end.",
                    ordered(), work.ticks, name, workers, work.rest));
  }

  void add_machine(MachineId machine) {
    if (options_.most_states == 0 || cancelled()) return;
    const auto problem = bounds::machine_problem(net_, machine);
    if (!problem || problem->jobs.size() < 2) return;
    std::size_t states = 0;
    const Tick ticks = sequenced(*problem, states);
    if (cancelled()) return;
    const std::string& name = line_.machines[machine.index()].name;
    add("machine:" + name, ticks,
        fmt::format("{} does one job after the other, travels between them, and each job has to "
                    "wait for what the line makes of the jobs before; the best order of its jobs "
                    "(of {} partial ones) ends then.",
                    name, states));
  }

  void add_worker(WorkerKindId kind) {
    if (options_.most_states == 0 || cancelled()) return;
    if (setup_.worker_start[kind.index()].size() != 1) return;
    const auto problem = bounds::worker_problem(net_, kind);
    if (!problem) return;
    std::size_t states = 0;
    const Tick ticks = sequenced(*problem, states);
    if (cancelled()) return;
    const std::string& name = line_.worker_kinds[kind.index()].name;
    add("worker:" + name, ticks,
        fmt::format("There is one {}, who does one task after the other and goes from each to the "
                    "next, and each task has to wait for what the line makes of the tasks before; "
                    "no order of the tasks (of {} partial ones) ends earlier.",
                    name, states));
  }

  /// Each case is bounded by the best argument in it.
  void add_combined() {
    if (cases_.size() < 2 || cancelled()) return;
    add("combined", *std::min_element(best_.begin(), best_.end()),
        fmt::format("Every run shares the tokens of the line's forks in one of {} ways; for each "
                    "way the best of the arguments here, and of these the least.",
                    cases_.size()));
  }

  [[nodiscard]] bool cancelled() const { return cancel_ != nullptr && cancel_->requested(); }

  const LineModel& line_;
  const RunSetup& setup_;
  const BoundOptions& options_;
  const CancelToken* cancel_;
  bounds::LineNet net_;
  std::vector<Case> cases_;
  std::vector<Tick> best_;  ///< by case
  std::vector<Bound> bounds_;
};

}  // namespace

std::vector<Bound> lower_bounds(const LineModel& line, const RunSetup& setup,
                                const BoundOptions& options, const CancelToken* cancel) {
  return Report(line, setup, options, cancel).make();
}

double gap(Tick upper, Tick lower) {
  return static_cast<double>(upper - lower) / static_cast<double>(std::max(1, lower));
}

}  // namespace linewright
