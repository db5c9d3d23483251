#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "limits.hpp"
#include "linewright/base/files.hpp"
#include "linewright/routing/map_ways.hpp"
#include "linewright/routing/route_cache.hpp"
#include "route_requests.hpp"
#include "travel.hpp"

namespace linewright::loading {
namespace {

/// Cells that the searches of all goals may visit, as if each visited all of them once.
double work_of(const HallMap& map, const std::vector<RouteRequest>& requests) {
  double goals = 0.0;
  for (const RouteRequest& request : requests) goals += static_cast<double>(request.stops.size());
  return static_cast<double>(map.grid->size()) * goals;
}

void warn(BuildState& state, const std::string& file, std::string message, std::string hint) {
  state.scenario.warnings.push_back({.severity = Diagnostic::Severity::kWarning,
                                     .file = file,
                                     .message = std::move(message),
                                     .hint = std::move(hint)});
}

/// The routes in the cache file, when it is there and fits.
std::optional<std::vector<RouteTable>> cached(BuildState& state, const std::string& file,
                                              std::uint64_t key,
                                              const std::vector<RouteRequest>& requests) {
  std::string why;
  const auto bytes = read_file(file, kLargestRouteCache, why);
  if (!bytes) return std::nullopt;
  CachedRoutes found = decode_routes(*bytes, key, requests);
  if (found.usable()) return std::move(found.tables);
  if (!found.outdated) {
    warn(state, file, fmt::format("the stored routes are ignored: {}", found.complaint),
         "the routes are planned anew, and the file is replaced");
  }
  return std::nullopt;
}

std::vector<RouteTable> built(const BuildState& state,
                              const std::shared_ptr<const ClearanceMap>& map,
                              const std::vector<RouteRequest>& requests) {
  const LoadOptions& options = state.options;
  RouteBuildOptions build{.threads = options.threads,
                          .cancel = options.cancel,
                          .progress = options.progress,
                          .most_expansions = options.most_route_work};
  auto tables = build_route_tables(map, requests, build);
  if (options.cancel != nullptr && options.cancel->requested()) {
    throw ScenarioError(state.scenario.file, "interrupted while planning the routes",
                        "nothing was stored; run it again");
  }
  return tables;
}

std::vector<RouteTable> routes_of(BuildState& state, const std::shared_ptr<const ClearanceMap>& map,
                                  const std::vector<RouteRequest>& requests) {
  const std::string file = state.route_cache_file;
  if (file.empty()) return built(state, map, requests);
  const std::uint64_t key = route_key(*state.scenario.map->grid, requests);
  if (auto tables = cached(state, file, key, requests)) return std::move(*tables);
  std::vector<RouteTable> tables = built(state, map, requests);
  // With a budget of its own a load may have given up what another one would find.
  const bool whole = state.options.most_route_work >= LoadOptions{}.most_route_work;
  if (whole) state.routes_to_store = encode_routes(tables, key);
  return tables;
}

void give_ways(BuildState& state) {
  LineModel& line = state.line();
  MapWaysData data{.grid = *state.scenario.map->grid,
                   .kinds = state.scenario.routes,
                   .motions = {},
                   .base = line.travel,
                   .stations = line.stations,
                   .zones = line.zones,
                   .tick_s = line.tick_s};
  for (const WorkerKind& kind : line.worker_kinds) {
    data.motions.push_back({kind.speed_mps, kind.turn_rate_radps, kind.acceleration_mps2});
  }
  line.ways = std::make_shared<const MapWays>(std::move(data));
}

}  // namespace

void fill_from_routes(BuildState& state, const std::vector<RoutedKind>& kinds) {
  // Inside of a map or a station that was reported there is nothing to search.
  if (!state.problems.none() || kinds.empty()) return;
  const HallMap& hall = *state.scenario.map;
  std::vector<KindRoutes> routed;
  std::vector<RouteRequest> requests;
  for (const RoutedKind& kind : kinds) {
    routed.push_back(route_request(state, kind));
    requests.push_back(routed.back().request);
  }
  if (work_of(hall, requests) > static_cast<double>(state.options.most_route_work)) {
    state.problems.error(kinds.front().mark,
                         "the map has too many cells to search the ways between all stations",
                         "make 'cell_m' larger, or the map's resolution coarser");
    return;
  }
  const auto map = std::make_shared<const ClearanceMap>(*hall.grid);
  bool all_free = true;
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    all_free = check_stops(state, routed[i], kinds[i], map) && all_free;
  }
  if (!all_free) return;
  std::vector<RouteTable> tables = routes_of(state, map, requests);
  LineModel& line = state.line();
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    routed[i].routes = std::move(tables[i]);
    line.travel[kinds[i].kind] = travel_table(routed[i], line.stations.size(), line.tick_s);
    state.scenario.routes[kinds[i].kind] = std::move(routed[i]);
  }
  give_ways(state);
}

void store_routes(BuildState& state) {
  if (state.routes_to_store.empty()) return;
  try {
    write_file(state.route_cache_file, state.routes_to_store);
  } catch (const ScenarioError& error) {
    warn(state, state.route_cache_file,
         "the routes could not be stored: " + error.diagnostics().front().message,
         "they will be planned again the next time");
  }
}

}  // namespace linewright::loading
