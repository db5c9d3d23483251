#pragma once

#include "cases.hpp"
#include "linewright/routing/path_planner.hpp"

namespace linewright::bench {

/// Hybrid A* as textbooks have it, to measure the library's against: a binary heap, nodes in a hash
/// map, every pose of a primitive checked by itself, the Reeds-Shepp length computed for every
/// node. The same primitives, costs, estimates and smoothing; it stops at the first connection to
/// the goal. It gives up after a million expansions.
class PlainHybridAStar {
 public:
  PlainHybridAStar(const Case& c, const PathPlannerOptions& options);
  ~PlainHybridAStar();

  [[nodiscard]] Path plan(const Query& query);
  [[nodiscard]] std::size_t expansions() const;

 private:
  class Search;
  std::unique_ptr<Search> search_;
};

}  // namespace linewright::bench
