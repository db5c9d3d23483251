#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "linewright/base/tick.hpp"
#include "linewright/line/line_model.hpp"
#include "linewright/simulation/run_setup.hpp"

namespace linewright {

/// All resources of a line at once, as a scheduling problem for a solver (CP-SAT): every run that
/// finishes before `limit` is a solution of one of the relaxations of its setup, so what a solver
/// proves of all of them holds for every planner and every allocator. Nodes are occurrences of
/// events ("the third cut ends"); a node is present when it happens before the limit.
struct JointRelaxation {
  static constexpr int kAbsent = -1;  ///< a node that cannot happen before the limit
  static constexpr int kAlways = -2;  ///< something that holds from the start on

  struct Node {
    std::string name;
    Tick least = 0;       ///< not before this tick
    bool needed = false;  ///< no run ends before the limit without it
  };
  /// `to` present: `from` is present, and to >= from + lag.
  struct Precedence {
    int from = 0;
    int to = 0;
    Tick lag = 0;
  };
  /// `node` present: all nodes of one of the options are present and not later.
  struct Either {
    int node = 0;
    std::vector<std::vector<int>> options;
  };
  /// Items that a task moves one by one, as many as it can in each execution. Item k belongs to one
  /// execution b, and no later item to an earlier one.
  struct Batch {
    std::vector<int> items;    ///< nodes: put down
    std::vector<int> decided;  ///< by execution: the task is chosen
    std::vector<int> begins;  ///< by execution: the transfer begins; item >= begin + before + takes
    std::vector<int> ends;    ///< by execution: it ends; end >= item + after
    int most = 1;             ///< items per execution
    Tick before = 0;
    Tick takes = 1;  ///< between two items of one execution
    Tick after = 0;
    int loaded_by = -1;  ///< index of an earlier batch whose items these are, by the same execution
    bool full = false;   ///< every execution but the last one moves `most`
    bool some = false;   ///< every execution moves at least one
    /// By item: it must have happened one tick before the decision of its execution. Or empty.
    std::vector<int> before_decision;
    /// By item: it must have happened one tick before every later decision. Or empty.
    std::vector<int> before_next_decision;
  };
  /// One stay of a resource.
  struct Job {
    int take = 0;    ///< node; kAlways: from the start on
    int begin = 0;   ///< node after which it sets out; kAbsent: not known
    int anchor = 0;  ///< node at which the resource is where the job needs it; kAbsent: nowhere
    int free = 0;    ///< node; kAbsent: not before the limit; kAlways: only `hold` is known
    Tick hold = 0;   ///< free again not before take + hold
    int type = 0;    ///< row of `lag`, `recovery` and `work`
    int number = 0;  ///< which execution, from 0
  };
  /// Something that is done at one moment, in which nobody may have the resource.
  struct Instant {
    int node = 0;
    Tick before = 0;  ///< 0: in the tick of the node; 1: in the whole tick before it
  };
  /// What a job takes at least, from its anchor until it is free again.
  struct Work {
    Tick base = 0;
    Tick each = 0;   ///< per item of `batch`
    int batch = -1;  ///< index; its execution of the job's number
  };
  struct Resource {
    std::string name;
    int capacity = 1;
    std::vector<Job> jobs;
    std::vector<Tick> recovery;  ///< by type: the next take >= free + this
    /// [type][next type]: next anchor >= free + this, for the job that follows directly. Or empty.
    std::vector<std::vector<Tick>> lag;
    /// [type][next type]: next anchor >= its begin + this, for the job that follows directly.
    std::vector<std::vector<Tick>> way;
    /// [unit of the resource][type]: the same for its first job. Or empty.
    std::vector<std::vector<Tick>> first_way;
    std::vector<Work> work;  ///< by type, where there are lags
    std::vector<Instant> instants;
    bool exclusive = true;  ///< its jobs exclude each other, too, not only the instants
  };

  Tick limit = 0;
  Tick least_end = 1;  ///< what is known without a solver
  std::vector<Node> nodes;
  std::vector<Precedence> precedences;
  std::vector<Either> eithers;
  std::vector<Batch> batches;
  std::vector<Resource> resources;
  std::vector<int> ends;  ///< nodes; the run ends when the last of them has happened
};

/// One for each way to share the tokens of the line's forks in which the run may end before
/// `limit`; none: no run of the setup ends before it.
[[nodiscard]] std::vector<JointRelaxation> joint_relaxations(const LineModel& line,
                                                             const RunSetup& setup, Tick limit);

}  // namespace linewright
