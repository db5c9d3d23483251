#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "linewright/base/id.hpp"
#include "linewright/simulation/simulator.hpp"

namespace linewright {

/// The high-level agent: which task comes next (paper, Sec. 3.3). One Planner serves one run at a
/// time; it may keep a random stream, which `reset` starts anew.
class Planner {
 public:
  virtual ~Planner() = default;

  /// Starts a new run. Equal seeds give equal choices in equal states.
  virtual void reset(std::uint64_t seed) = 0;

  /// The task to start at tick now + 1, one that is selectable in `state`; none: wait (only where
  /// LineModel::allow_wait is set). Called only when a decision is due.
  [[nodiscard]] virtual std::optional<TaskId> choose_task(const SimulationState& state) = 0;
};

/// The planners a name can stand for. The name may be followed by ':' and what the planner takes:
/// - `random`: uniform over the selectable tasks
/// - `first`: the selectable task with the lowest number
/// - `priority:LIST`: the first selectable task of a comma-separated list of task numbers or names;
///   tasks that the list leaves out come last, by number
/// - `policy:FILE`: a learned policy (policy_planner.hpp)
class PlannerRegistry {
 public:
  struct Entry {
    std::string name;
    std::string takes;  ///< what may follow the ':'; empty: nothing
    std::string summary;
  };

  [[nodiscard]] static const std::vector<Entry>& entries();

  /// Throws ScenarioError for an unknown name or a bad list. The simulator must outlive the
  /// planner.
  [[nodiscard]] static std::unique_ptr<Planner> make(std::string_view spec,
                                                     const Simulator& simulator);
};

}  // namespace linewright
