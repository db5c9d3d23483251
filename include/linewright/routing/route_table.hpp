#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "linewright/base/cancel.hpp"
#include "linewright/map/collision_checker.hpp"
#include "linewright/routing/path_planner.hpp"

namespace linewright {

/// A station as one kind of worker sees it: the paper's area node.
struct RouteStop {
  std::string name;
  Pose2 pose;
};

/// What the routes of one kind of worker follow from.
struct RouteRequest {
  std::string kind;
  std::string planner = "hybrid_a_star";  ///< one of path_planner_names()
  Mover mover;
  PathPlannerOptions options;
  std::vector<RouteStop> stops;
};

/// The paths between every ordered pair of stops of one kind: the paper's Node_Graph (Algorithm 2,
/// step 1). A path from a stop to itself is found and empty.
class RouteTable {
 public:
  RouteTable() = default;
  explicit RouteTable(std::size_t stops) : stops_(stops), paths_(stops * stops) {}

  [[nodiscard]] std::size_t stops() const { return stops_; }
  [[nodiscard]] const Path& path(std::size_t from, std::size_t to) const {
    return paths_[from * stops_ + to];
  }
  void set(std::size_t from, std::size_t to, Path path) {
    paths_[from * stops_ + to] = std::move(path);
  }
  /// Ordered pairs of different stops, and those of them without a path.
  [[nodiscard]] std::size_t pairs() const { return stops_ * (stops_ == 0 ? 0 : stops_ - 1); }
  [[nodiscard]] std::size_t failed() const;

 private:
  std::size_t stops_ = 0;
  std::vector<Path> paths_;
};

/// How route tables are built.
struct RouteBuildOptions {
  std::size_t threads = 0;  ///< 0: one per core. The result does not depend on it
  const CancelToken* cancel = nullptr;
  std::function<void(std::size_t done, std::size_t total)> progress;  ///< pairs; from any thread
  /// Expansions of all searches together after which the rest is given up as kSearchLimit. Only a
  /// bound for hostile input: where it is reached, the result depends on the threads.
  std::size_t most_expansions = SIZE_MAX;
};

/// The table of each request, all on one map. All starts of one goal share its heuristic. When
/// cancelled, the pairs that are missing have the status kSearchLimit.
[[nodiscard]] std::vector<RouteTable> build_route_tables(
    const std::shared_ptr<const ClearanceMap>& map, const std::vector<RouteRequest>& requests,
    const RouteBuildOptions& options = {});

/// Why there is no path, for the user: which of the two places is occupied, that an aisle is
/// blocked, or that the turning radius or the footprint leaves no room to manoeuvre.
[[nodiscard]] std::string explain_missing(const RouteRequest& request, std::size_t from,
                                          std::size_t to, PathStatus status);

}  // namespace linewright
