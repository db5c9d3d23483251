#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "linewright/routing/path_planner.hpp"
#include "linewright/routing/route_table.hpp"

namespace linewright::bench {

struct Query {
  Pose2 start;
  Pose2 goal;
};

/// What is planned: one mover on one map, and from where to where.
struct Case {
  std::string name;
  std::shared_ptr<const OccupancyGrid> grid;
  std::shared_ptr<const ClearanceMap> map;
  Mover mover;
  std::vector<Query> queries;
};

/// 1.4 m x 0.9 m, turning radius 0.8 m: the duct line's robot.
[[nodiscard]] Mover long_robot();
/// Radius 0.4 m, turning radius 0.6 m.
[[nodiscard]] Mover round_robot();

/// A seeded hall of `size` x `size` cells of 0.25 m, `percent` of them occupied by boxes of 2 to 12
/// cells, and `queries` pairs of poses around which the mover can turn. The same pairs in every
/// run.
[[nodiscard]] Case random_case(std::int32_t size, std::size_t percent, const Mover& mover,
                               std::size_t queries);

/// The duct line with ways searched on its map.
struct DuctHall {
  std::shared_ptr<const OccupancyGrid> grid;
  std::shared_ptr<const ClearanceMap> map;
  std::vector<RouteRequest> requests;  ///< human, robot
};
[[nodiscard]] DuctHall duct_hall();
/// All ordered pairs of different stops of a request, or every `stride`th.
[[nodiscard]] Case hall_case(const DuctHall& hall, const RouteRequest& request,
                             std::size_t stride = 1);

}  // namespace linewright::bench
