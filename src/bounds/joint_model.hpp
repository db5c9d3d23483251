#pragma once

#include "cases.hpp"
#include "line_net.hpp"
#include "linewright/bounds/joint_relaxation.hpp"

namespace linewright::bounds {

/// Turns the event net of one case into nodes and what binds them.
class JointModel {
 public:
  JointModel(const LineNet& net, const Case& one, Tick limit);

  JointRelaxation build();

  [[nodiscard]] const LineNet& net() const { return net_; }
  /// The node of the n-th occurrence (n < 1: always).
  [[nodiscard]] int node(int event, int n) const;
  [[nodiscard]] const Times& times() const { return times_; }
  [[nodiscard]] int columns() const { return times_.columns(); }
  /// The nodes of the 1st, 2nd, ... occurrence, as far as they can happen before the limit.
  [[nodiscard]] std::vector<int> nodes_of(int event) const;

  JointRelaxation made;

 private:
  void number_nodes();
  void mark_needed();
  void add_rules();
  void add_arc(int event, int n, const Arc& arc);
  void add_count(int event, int n);
  void precede(int from, int to, Tick lag);

  const LineNet& net_;
  const Times& times_;
  std::vector<int> first_;  ///< by event: its first node
  std::vector<int> count_;  ///< by event: nodes
};

// The parts that are not in the net.
void add_batches(JointModel& model);
void add_workers(JointModel& model);
void add_carriers(JointModel& model);
void add_machines(JointModel& model);
void add_berths(JointModel& model);
void add_decisions(JointModel& model);

/// The only task that parks carriers in a berth and the only one that takes them from there: the
/// n-th of one and the n-th of the other have the same carrier.
struct BerthTasks {
  std::size_t parks = 0;
  std::size_t takes = 0;
};
[[nodiscard]] std::optional<BerthTasks> tasks_of_berth(const LineModel& line, PlaceId berth);

/// The decisions and starts whose condition asks for the variable to be 1 (or the count to be
/// above 0) and nothing that could hold without it; `value` what it must be: at least 1, or 0.
[[nodiscard]] std::vector<JointRelaxation::Instant> instants_asking(const JointModel& model,
                                                                    const Variable& variable,
                                                                    bool zero);

}  // namespace linewright::bounds
