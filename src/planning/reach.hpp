#pragma once

#include <optional>
#include <vector>

#include "linewright/line/line_model.hpp"
#include "linewright/line/lower_limits.hpp"
#include "linewright/line/materials.hpp"
#include "linewright/simulation/simulator.hpp"

namespace linewright {

/// A quick test whether the order can still be finished: how many tokens could ever come to each
/// place if nobody had to share any, no machine or room was ever missing and carriers were lost
/// only where they are parked. Says no only when it is certain.
class Reach {
 public:
  /// The simulator must outlive it.
  explicit Reach(const Simulator& simulator);

  /// False: the order cannot be finished from this state, whatever happens.
  [[nodiscard]] bool may_finish(const SimulationState& state);

 private:
  struct Flow {
    std::vector<std::pair<int, std::int64_t>> takes;
    std::vector<std::pair<int, std::int64_t>> gives;
    int operation = -1;
    int task = -1;
  };
  struct Parking {
    int task = 0;
    std::size_t slot = 0;
    int berth = 0;
  };

  void add_operations();
  void add_task(std::size_t t);
  void add_transfer(int t, const Task& task, const TransferAction& transfer);
  [[nodiscard]] int store_of(const Task& task, const Endpoint& here, const Endpoint& there) const;
  [[nodiscard]] int pool(int kind, int material) const;
  void begin(const SimulationState& state);
  void count_carriers(const SimulationState& state);
  bool start_tasks();
  bool fire();
  void fill_limits(std::int32_t order);
  [[nodiscard]] bool limits_hold(const std::vector<LowerLimit>& limits) const;
  [[nodiscard]] bool can_start(std::size_t t);
  [[nodiscard]] bool limit_holds(Variable variable, std::int64_t value) const;
  [[nodiscard]] bool can_fire(const Flow& flow) const;
  [[nodiscard]] std::optional<int> parked_in(std::size_t task, std::size_t slot) const;
  bool bring(int store, std::int64_t tokens);

  const Simulator& simulator_;
  const LineModel& line_;
  Materials materials_;
  std::vector<Flow> flows_;
  std::vector<Parking> parkings_;
  std::vector<std::vector<bool>> operated_;  ///< [operation][task]
  std::vector<std::vector<LowerLimit>> task_limits_;
  std::vector<std::vector<LowerLimit>> operation_limits_;
  std::vector<LowerLimit> done_limits_;
  std::int32_t limits_order_ = -1;  ///< the order that the limits are of
  // Of the state that is looked at.
  std::int64_t lots_ = 0;             ///< as good as without limit
  std::vector<std::int64_t> tokens_;  ///< by store
  std::vector<std::int64_t> fired_;   ///< by flow
  std::vector<bool> possible_;        ///< by task: under way, or can be started
  std::vector<bool> carrier_free_;    ///< by kind
  std::vector<bool> in_berth_;        ///< by place
  std::vector<int> workers_;          ///< by kind
  std::vector<int> needed_;
};

}  // namespace linewright
