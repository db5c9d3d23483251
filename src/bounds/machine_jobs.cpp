#include <algorithm>

#include "couplings.hpp"
#include "sequence.hpp"

namespace linewright::bounds {
namespace {

/// The least tick in which the machine is at `target`, when it has come to rest at `position` not
/// before `free`, and is not called before `from`. Waiting, or resting later, may bring it nearer.
Tick least_arrival(const Machine& machine, int position, int target, Tick free, Tick recovery,
                   Tick from) {
  const Tick called = std::max(free + recovery, from);
  if (position < 0 || target < 0) return called;
  const Tick homed = machine.homing
                         ? std::max(0, machine.homing->takes[static_cast<std::size_t>(position)]) +
                               machine.homing->holds
                         : 0;
  Tick least_travel = kNever;  // of all times for which it may have rested by then
  Tick best = kNever;
  Tick rested = recovery;
  for (Tick tick = called; tick <= called + homed + 1; ++tick) {
    for (; rested <= std::min(tick - free, recovery + homed + 1); ++rested)
      least_travel = std::min(least_travel, machine_travel(machine, position, target, rested));
    best = std::min(best, tick + least_travel);
  }
  return best;
}

}  // namespace

std::optional<SequenceProblem> machine_problem(const LineNet& net, MachineId machine) {
  const std::vector<MachineJob> jobs = jobs_of(net, machine);
  if (jobs.empty()) return std::nullopt;
  SequenceProblem problem;
  for (const MachineJob& job : jobs) {
    if (job.rests.empty()) return std::nullopt;
    JobType& made = problem.jobs.emplace_back();
    made.name = net.line.operations[job.operation].name;
    made.start = net.starts[job.operation];
    made.unit = made.anchor = made.end = net.ends[job.operation];
    made.place = job.from;
    made.before = job.work;
    made.variants = {{.anchor_to_end = 0, .units = {0}}};
    for (const Rest& rest : job.rests)
      made.ends.push_back({.place = rest.position, .after = rest.ticks, .recovery = rest.recovery});
  }
  problem.conditions.resize(problem.jobs.size());
  problem.starts = {net.line.machines[machine.index()].start};
  problem.anchor = [&net, machine](int place, Tick free, Tick recovery, Tick from,
                                   const JobType& job) {
    return least_arrival(net.line.machines[machine.index()], place, job.place, free, recovery,
                         from) +
           job.before;
  };
  return problem;
}

}  // namespace linewright::bounds
