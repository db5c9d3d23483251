#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "linewright/map/occupancy_grid.hpp"
#include "linewright/routing/route_table.hpp"

namespace linewright {

/// A number that changes with everything that routes follow from: the cells and their frame,
/// footprints, turning radii, planners, options, stops and the version of the search itself.
[[nodiscard]] std::uint64_t route_key(const OccupancyGrid& grid,
                                      const std::vector<RouteRequest>& requests);

/// The bytes of a cache file (docs/formats/route_cache.md): tables under a key. The same on every
/// platform.
[[nodiscard]] std::string encode_routes(const std::vector<RouteTable>& tables, std::uint64_t key);

/// What came out of a cache file.
struct CachedRoutes {
  std::vector<RouteTable> tables;
  /// Why the file cannot be used ("it is damaged", ...); empty when it can. A file under another
  /// key is merely out of date: `outdated`, and no complaint.
  std::string complaint;
  bool outdated = false;

  [[nodiscard]] bool usable() const { return complaint.empty() && !outdated; }
};

/// Never throws and never reads beyond the bytes; anything odd is a complaint.
[[nodiscard]] CachedRoutes decode_routes(std::string_view bytes, std::uint64_t key,
                                         const std::vector<RouteRequest>& requests);

}  // namespace linewright
