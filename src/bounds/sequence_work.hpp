#pragma once

#include <cstdint>
#include <vector>

#include "sequence.hpp"
#include "sequence_lags.hpp"

namespace linewright::bounds {

/// What the jobs of one resource take in the least, without the ways between them.
class Work {
 public:
  Work(const LineNet& net, const SequenceProblem& problem, const Lags& lags);

  /// A tick before which the run cannot end when these units are done and the resource is free:
  /// some of the work that is left, and what must follow the last of it.
  [[nodiscard]] Tick least_end(const std::vector<std::int16_t>& units, Tick free) const;
  /// Of the whole order.
  [[nodiscard]] Workload all() const;

 private:
  void weigh_jobs();
  void weigh_tails();
  void weigh_order();
  [[nodiscard]] double work_of(const Flow& flow) const;
  [[nodiscard]] double units_of(const JobType& job, TaskId task, const Flow& flow) const;

  const LineNet& net_;
  const SequenceProblem& problem_;
  const Lags& lags_;
  std::vector<std::vector<Tick>> least_work_;  ///< by job and units
  std::vector<double> unit_work_;              ///< by job: the least per unit
  double all_work_ = 0.0;
  std::vector<std::vector<Tick>> tails_;  ///< by job and units done: from any later unit to the end
  std::vector<Tick> rests_;               ///< by job: what of it can lie after its first unit
  Tick longest_rest_ = 0;
};

}  // namespace linewright::bounds
