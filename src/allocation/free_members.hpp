#pragma once

#include <cstdint>
#include <vector>

#include "linewright/line/task.hpp"
#include "linewright/simulation/simulator.hpp"

namespace linewright::allocation {

/// Where a worker counts as being.
enum class Standpoint : std::uint8_t {
  kReal,     ///< where it really is
  kStation,  ///< at the station of its state; of one under way: where it is going
  kSnapped,  ///< at the station nearest to where it is, in a straight line (paper, Sec. 3.4)
};

/// Free workers that are equally far from everything, by their first.
struct Start {
  std::int16_t worker = -1;   ///< the lowest number among them
  std::int16_t station = -1;  ///< where they count as being; kReal under way: where it is going
};

/// Carriers that stand at the same station, by their first.
struct Spot {
  std::int16_t carrier = -1;  ///< the lowest number among them
  std::int16_t station = -1;
};

/// Finds who could fill a crew slot. Workers (and carriers) of a kind at the same station differ
/// only in their number, so the lists are as long as there are stations, not as there are workers;
/// those under way stand in them one by one. Each list lives until the same function is called
/// again. Allocates only in the first call for a state of a size not met before.
class FreeMembers {
 public:
  explicit FreeMembers(const Simulator& simulator) : simulator_(simulator) {}

  /// The free workers for worker slot `slot` that fill no other slot of `so_far`, put together.
  [[nodiscard]] const std::vector<Start>& starts(const SimulationState& state,
                                                 const Assignment& so_far, std::size_t slot,
                                                 Standpoint standpoint);

  /// The carriers that fit carrier slot `slot` of `task`, put together.
  [[nodiscard]] const std::vector<Spot>& spots(const SimulationState& state, TaskId task,
                                               std::size_t slot);

  /// As starts() and spots(), but every single one, by number.
  [[nodiscard]] const std::vector<std::int16_t>& workers(const SimulationState& state,
                                                         const Assignment& so_far,
                                                         std::size_t slot);
  [[nodiscard]] const std::vector<std::int16_t>& carriers(const SimulationState& state, TaskId task,
                                                          std::size_t slot);

  /// The first carrier by number that fits carrier slot `slot` and fills no other slot of `so_far`;
  /// kNobody: none does.
  [[nodiscard]] std::int16_t first_carrier(const SimulationState& state, const Assignment& so_far,
                                           std::size_t slot) const;

 private:
  template <class Visit>
  void each_worker(const SimulationState& state, const Assignment& so_far, std::size_t slot,
                   Visit&& visit) const;
  const Simulator& simulator_;
  std::vector<Start> starts_;
  std::vector<Spot> spots_;
  std::vector<std::int16_t> workers_;
  std::vector<std::int16_t> carriers_;
  std::vector<std::uint8_t> seen_;  ///< by station: whether it has its entry already
};

}  // namespace linewright::allocation
