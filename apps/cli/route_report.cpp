#include "route_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "common.hpp"

namespace linewright::cli {
namespace {

using Json = nlohmann::ordered_json;

/// Counts and lengths of the routes of one kind.
struct KindFacts {
  std::size_t found = 0;
  double metres = 0.0;
  std::int64_t ticks = 0;
  double longest_m = 0.0;
  Tick longest_ticks = 0;
  std::size_t from = 0;  ///< of the longest
  std::size_t to = 0;

  [[nodiscard]] double mean_m() const { return found == 0 ? 0.0 : metres / divisor(); }
  [[nodiscard]] double mean_ticks() const {
    return found == 0 ? 0.0 : static_cast<double>(ticks) / divisor();
  }

 private:
  [[nodiscard]] double divisor() const { return static_cast<double>(found); }
};

/// Calls `visit(from, to, path)` for every ordered pair of different stops.
template <typename Visit>
void for_each_pair(const KindRoutes& kind, Visit visit) {
  for (std::size_t from = 0; from < kind.routes.stops(); ++from) {
    for (std::size_t to = 0; to < kind.routes.stops(); ++to) {
      if (from != to) visit(from, to, kind.routes.path(from, to));
    }
  }
}

KindFacts facts_of(const KindRoutes& kind, double tick_s) {
  KindFacts facts;
  for_each_pair(kind, [&](std::size_t from, std::size_t to, const Path& path) {
    const Leg leg = way_of(path, kind.motion, tick_s).leg;
    if (!path.found() || leg.ticks < 0) return;
    ++facts.found;
    facts.metres += leg.metres;
    facts.ticks += leg.ticks;
    facts.longest_ticks = std::max(facts.longest_ticks, leg.ticks);
    if (leg.metres <= facts.longest_m) return;
    facts.longest_m = leg.metres;
    facts.from = from;
    facts.to = to;
  });
  return facts;
}

std::string name_of(const KindRoutes& kind, std::size_t stop) {
  return kind.request.stops[stop].name;
}

Json kind_json(const KindRoutes& kind, const KindFacts& facts) {
  Json object{{"kind", kind.request.kind},
              {"planner", kind.request.planner},
              {"stations", kind.request.stops.size()},
              {"pairs", kind.routes.pairs()},
              {"failed", kind.routes.failed()},
              {"mean_m", nullptr},
              {"longest_m", nullptr},
              {"mean_ticks", nullptr},
              {"longest_ticks", nullptr},
              {"longest", nullptr}};
  if (facts.found == 0) return object;
  object["mean_m"] = facts.mean_m();
  object["longest_m"] = facts.longest_m;
  object["mean_ticks"] = facts.mean_ticks();
  object["longest_ticks"] = facts.longest_ticks;
  object["longest"] = {name_of(kind, facts.from), name_of(kind, facts.to)};
  return object;
}

void add_routes(const KindRoutes& kind, double tick_s, Json& routes) {
  for_each_pair(kind, [&](std::size_t from, std::size_t to, const Path& path) {
    Json route{{"kind", kind.request.kind}, {"from", name_of(kind, from)},
               {"to", name_of(kind, to)},   {"metres", nullptr},
               {"ticks", nullptr},          {"status", linewright::name_of(path.status)}};
    const Leg leg = way_of(path, kind.motion, tick_s).leg;
    if (path.found()) route["metres"] = leg.metres;
    if (path.found() && leg.ticks >= 0) route["ticks"] = leg.ticks;
    if (!path.found()) route["reason"] = explain_missing(kind.request, from, to, path.status);
    routes.push_back(std::move(route));
  });
}

std::string kinds_text(const Scenario& scenario) {
  std::vector<std::vector<std::string>> rows{{"worker", "planner", "stations", "pairs", "found",
                                              "failed", "mean m", "longest m", "mean ticks",
                                              "longest ticks", "longest way"}};
  for (const auto& kind : scenario.routes) {
    if (!kind) continue;
    const KindFacts facts = facts_of(*kind, scenario.line.tick_s);
    const bool any = facts.found > 0;
    const std::size_t failed = kind->routes.failed();
    rows.push_back(
        {kind->request.kind, kind->request.planner, std::to_string(kind->request.stops.size()),
         std::to_string(kind->routes.pairs()), std::to_string(kind->routes.pairs() - failed),
         std::to_string(failed), any ? fmt::format("{:.2f}", facts.mean_m()) : "-",
         any ? fmt::format("{:.2f}", facts.longest_m) : "-",
         any ? fmt::format("{:.1f}", facts.mean_ticks()) : "-",
         any ? std::to_string(facts.longest_ticks) : "-",
         any ? name_of(*kind, facts.from) + " -> " + name_of(*kind, facts.to) : "-"});
  }
  return text_table(rows);
}

std::string missing_text(const Scenario& scenario) {
  std::string text;
  for (const auto& kind : scenario.routes) {
    if (!kind) continue;
    for_each_pair(*kind, [&](std::size_t from, std::size_t to, const Path& path) {
      if (path.found()) return;
      text +=
          fmt::format("  {}: {} -> {}: {}\n", kind->request.kind, name_of(*kind, from),
                      name_of(*kind, to), explain_missing(kind->request, from, to, path.status));
    });
  }
  return text.empty() ? "" : "\npairs without a route\n" + text;
}

std::string times_text(const RouteTimes& times) {
  return fmt::format(
      "\nplanned anew  {:.1f} ms on {} thread{}\nfrom a cache  {:.3f} ms (median of {}; {} "
      "bytes)\n",
      times.cold_ms, times.threads, times.threads == 1 ? "" : "s", times.cached_ms, times.readings,
      times.bytes);
}

}  // namespace

nlohmann::ordered_json routes_json(const Scenario& scenario, const RouteTimes& times) {
  Json object{{"line", scenario.line.name},
              {"pairs", 0},
              {"failed", 0},
              {"threads", times.threads},
              {"cold_ms", times.cold_ms},
              {"cached_ms", times.cached_ms},
              {"cache_bytes", times.bytes},
              {"kinds", Json::array()},
              {"routes", Json::array()}};
  std::size_t pairs = 0;
  std::size_t failed = 0;
  for (const auto& kind : scenario.routes) {
    if (!kind) continue;
    pairs += kind->routes.pairs();
    failed += kind->routes.failed();
    object["kinds"].push_back(kind_json(*kind, facts_of(*kind, scenario.line.tick_s)));
    add_routes(*kind, scenario.line.tick_s, object["routes"]);
  }
  object["pairs"] = pairs;
  object["failed"] = failed;
  return object;
}

std::string routes_text(const Scenario& scenario, const RouteTimes& times) {
  return kinds_text(scenario) + times_text(times) + missing_text(scenario);
}

}  // namespace linewright::cli
