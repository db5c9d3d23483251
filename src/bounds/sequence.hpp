#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "line_net.hpp"
#include "linewright/base/cancel.hpp"

namespace linewright::bounds {

/// One way in which a job can end: where the resource then is, and when it can be taken again.
struct JobEnd {
  int place = -1;     ///< -1: not known
  Tick after = 0;     ///< ticks from the job's end event until it is there
  Tick recovery = 0;  ///< ticks after that before it can be taken again
};

/// What one resource does again and again, one job after the other. What is counted of a job are
/// its units: executions, or items where one execution may move several.
struct JobType {
  /// An execution that moves `units` units.
  struct Variant {
    Tick anchor_to_end = 0;
    std::vector<Tick> units;  ///< ticks from the anchor to each unit
  };

  std::string name;
  int unit = -1;    ///< event that is counted
  int start = -1;   ///< event not before which the resource is taken; -1: any time
  int anchor = -1;  ///< event at which the resource is where the job needs it
  int end = -1;     ///< event at which it has done its part
  int place = -1;   ///< where it is needed; -1: anywhere
  Tick before = 0;  ///< ticks from taking it to setting out, and from arriving to the anchor
  Tick least = 0;   ///< least ticks of the way there
  std::vector<Variant> variants;
  /// Above 0: so many units there are in all, and each execution moves as many as fit of what is
  /// left of them.
  int supply = 0;
  std::vector<JobEnd> ends;
};

/// Condition on the counts at the start of a job: sum(coefficient * units of a job) + constant
/// RELATION 0.
struct CountCondition {
  std::vector<std::pair<std::size_t, int>> terms;
  std::int64_t constant = 0;
  Relation relation = Relation::kGreater;
};

struct SequenceProblem {
  std::vector<JobType> jobs;
  std::vector<std::vector<CountCondition>> conditions;  ///< by job
  std::vector<int> starts;                              ///< places where the resource may begin
  /// The anchor of a job of a resource that is at `place` from `free` on, not taken before `from`.
  std::function<Tick(int place, Tick free, Tick recovery, Tick from, const JobType&)> anchor;
};

struct SequenceResult {
  Tick ticks = 1;
  std::size_t states = 0;
};

/// A tick before which the order cannot be finished when the jobs of one resource are done one
/// after the other, in whichever order and number is best, each not before what the net says of it
/// after those before; everything else competes for nothing. Looks no further than `enough`, and
/// gives up raising the bound when there are more than `most_states` states of one number of units.
[[nodiscard]] SequenceResult best_sequence(const LineNet& net, const Times& times,
                                           const SequenceProblem& problem, Tick enough,
                                           std::size_t most_states, const CancelToken* cancel);

/// What the workers of a kind have to do for the order in all, without the ways between their jobs.
struct Workload {
  Tick ticks = 0;
  Tick rest = 0;  ///< at most so much of one worker's share can lie after the end of the run
};
[[nodiscard]] Workload workload_of(const LineNet& net, const Times& times,
                                   const SequenceProblem& problem, const CancelToken* cancel);

/// The jobs of one worker of a kind, that of the first start; none where they are not one after the
/// other.
[[nodiscard]] std::optional<SequenceProblem> worker_problem(const LineNet& net, WorkerKindId kind);
/// The jobs of a machine; none where its holdings are not understood.
[[nodiscard]] std::optional<SequenceProblem> machine_problem(const LineNet& net, MachineId machine);

}  // namespace linewright::bounds
