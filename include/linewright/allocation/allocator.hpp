#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "linewright/base/id.hpp"
#include "linewright/simulation/simulator.hpp"

namespace linewright {

/// The low-level agent: given the chosen task, who does it (paper, Sec. 3.4). One Allocator serves
/// one run at a time; it may keep a random stream, which `reset` starts anew.
class Allocator {
 public:
  virtual ~Allocator() = default;

  /// Starts a new run. Equal seeds give equal allocations.
  virtual void reset(std::uint64_t seed) = 0;

  /// Who does `task`. The task must be selectable in `state`; the result is then a valid
  /// assignment.
  [[nodiscard]] virtual Assignment allocate(const SimulationState& state, TaskId task) = 0;

  /// Whether it draws at random: equal states may then get different answers.
  [[nodiscard]] virtual bool draws() const { return false; }

  /// Who joins a running task. A worker of the slot's kind must be free.
  [[nodiscard]] virtual WorkerId join(const SimulationState& state, PendingJoin pending) = 0;
};

/// Names that make_allocator knows:
/// - `sap`: the nearest by route, from where each one really is; carriers together with who fetches
///   them (the paper's SAP, Algorithm 2)
/// - `no_spatial`: uniformly at random (the paper's NoSpatial)
/// - `longest_path`: the farthest by route (the paper's LongestPath)
/// - `first_idle`: the first free worker and the first free carrier by number; who fetches a
///   carrier is the one nearest to it in a straight line (what the paper's published runs did)
/// - `sap_snapped`: as `sap`, but each worker counts as standing at the station (with a pose for
///   its kind) that is nearest to it in a straight line (the paper's Sec. 3.4); differs from `sap`
///   only for workers who are free while under way
/// Equally good ones: the first carrier by number, then the first worker. One for whom no way is
/// known comes last. A decision takes time in proportion to the workers and carriers, plus that for
/// one way from every station where free ones stand to every station where such carriers stand.
[[nodiscard]] const std::vector<std::string>& allocator_names();

/// Throws ScenarioError for a name that is not among allocator_names(). The simulator must outlive
/// the allocator.
[[nodiscard]] std::unique_ptr<Allocator> make_allocator(std::string_view name,
                                                        const Simulator& simulator);

}  // namespace linewright
