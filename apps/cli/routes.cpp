#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>

#include "common.hpp"
#include "linewright/base/diagnostic.hpp"
#include "linewright/evaluation/routes_svg.hpp"
#include "linewright/scenario/load.hpp"
#include "route_times.hpp"

namespace linewright::cli {
namespace {

using Json = nlohmann::ordered_json;

struct RoutesArguments {
  std::string scenario;
  std::string svg;
  std::vector<std::string> starts;
  std::vector<std::string> kinds;
  std::size_t threads = 0;
  bool no_cache = false;
  bool json = false;
};

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

/// What is shown: the scenario with the routes of the kinds that were asked for.
Scenario load(const RoutesArguments& arguments) {
  ProgressBar bar("routes");
  std::mutex drawing;
  LoadOptions options;
  options.route_cache = !arguments.no_cache;
  options.threads = arguments.threads;
  options.cancel = &interrupted();
  options.progress = [&](std::size_t done, std::size_t total) {
    const std::scoped_lock lock(drawing);
    bar.update(done, total);
  };
  return load_scenario(arguments.scenario, options);
}

std::vector<std::string> routed_kinds(const Scenario& scenario) {
  std::vector<std::string> names;
  for (const auto& kind : scenario.routes) {
    if (kind) names.push_back(kind->request.kind);
  }
  return names;
}

/// Throws when nothing is routed, with what to write for this scenario's workers.
void require_routes(const RoutesArguments& arguments, const Scenario& scenario) {
  if (!routed_kinds(scenario).empty()) return;
  std::string travel;
  for (const WorkerKind& kind : scenario.line.worker_kinds) {
    travel += (travel.empty() ? "" : ", ") + kind.name + ": hybrid_a_star";
  }
  throw ScenarioError(
      arguments.scenario, "no worker's ways come from a map: there are no routes to show",
      fmt::format("{}write travel: {{{}}}",
                  scenario.map ? "" : "give it a map (docs/formats/scenario.md#map) and ", travel));
}

/// Forgets the kinds that --kind leaves out.
void keep_kinds(const RoutesArguments& arguments, Scenario& scenario) {
  const std::vector<std::string> routed = routed_kinds(scenario);
  for (const std::string& kind : arguments.kinds) {
    if (std::find(routed.begin(), routed.end(), kind) != routed.end()) continue;
    throw ScenarioError(
        {}, fmt::format("--kind: no worker called {} has routes on the map", in_quotes(kind)),
        name_hint(kind, routed));
  }
  for (auto& kind : scenario.routes) {
    const auto& wanted = arguments.kinds;
    if (kind && !wanted.empty() &&
        std::find(wanted.begin(), wanted.end(), kind->request.kind) == wanted.end()) {
      kind.reset();
    }
  }
}

/// The panels that start at a station, one per kind that goes there.
void add_panels(const Scenario& scenario, const std::string& start,
                std::vector<RoutesPanel>& panels) {
  std::vector<std::string> known;
  const std::size_t before = panels.size();
  for (std::size_t k = 0; k < scenario.routes.size(); ++k) {
    if (!scenario.routes[k]) continue;
    const std::vector<RouteStop>& stops = scenario.routes[k]->request.stops;
    for (std::size_t i = 0; i < stops.size(); ++i) {
      if (stops[i].name == start) panels.push_back({k, i});
      known.push_back(stops[i].name);
    }
  }
  if (panels.size() > before) return;
  throw ScenarioError({}, fmt::format("--start: no route starts at {}", in_quotes(start)),
                      name_hint(start, known));
}

std::vector<RoutesPanel> panels_of(const RoutesArguments& arguments, const Scenario& scenario) {
  if (arguments.starts.empty()) return showcase_panels(scenario);
  std::vector<RoutesPanel> panels;
  for (const std::string& start : arguments.starts) add_panels(scenario, start, panels);
  std::stable_sort(panels.begin(), panels.end(),
                   [](const RoutesPanel& a, const RoutesPanel& b) { return a.kind < b.kind; });
  return panels;
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

Json json_of(const Scenario& scenario, const RouteTimes& times) {
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

int interrupted_code() {
  report("interrupted while planning the routes: nothing was written");
  return kInterrupted;
}

int show(const RoutesArguments& arguments) {
  if (arguments.svg.empty() && !arguments.starts.empty()) {
    throw ScenarioError({}, "--start chooses what the picture shows, but no picture is written",
                        "add --svg FILE.svg");
  }
  Scenario scenario;
  try {
    scenario = load(arguments);
  } catch (const ScenarioError&) {
    if (interrupted().requested()) return interrupted_code();
    throw;
  }
  for (const Diagnostic& warning : scenario.warnings) report(to_string(warning));
  require_routes(arguments, scenario);
  keep_kinds(arguments, scenario);
  const std::vector<RoutesPanel> panels = panels_of(arguments, scenario);
  const auto times = time_routes(scenario, arguments.threads);
  if (!times) return interrupted_code();
  if (!arguments.svg.empty()) write_routes(scenario, panels, arguments.svg);
  if (arguments.json) {
    Json object = json_of(scenario, *times);
    if (!arguments.svg.empty()) object["svg"] = arguments.svg;
    print(object.dump(2) + "\n");
    return kOk;
  }
  print(kinds_text(scenario) + times_text(*times) + missing_text(scenario) +
        (arguments.svg.empty() ? "" : "\npicture  " + arguments.svg + "\n"));
  return kOk;
}

}  // namespace

Command add_routes(CLI::App& app) {
  auto arguments = std::make_shared<RoutesArguments>();
  app.add_option("scenario", arguments->scenario, "Scenario file (docs/formats/scenario.md)")
      ->required()
      ->type_name("SCENARIO");
  app.add_option("--svg", arguments->svg, "Draw the hall and the routes from some stations")
      ->type_name("FILE.svg");
  app.add_option("--start", arguments->starts,
                 "Draw the routes from this station, a panel for each kind of worker; repeatable "
                 "(default: two far apart for each kind)")
      ->type_name("STATION")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app.add_option("--kind", arguments->kinds,
                 "Only the routes of this kind of worker; repeatable (default: all)")
      ->type_name("KIND")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app.add_option("--threads", arguments->threads,
                 "Threads; 0: one per core. Routes do not depend on it")
      ->capture_default_str()
      ->check(CLI::Range(std::size_t{0}, std::size_t{1024}))
      ->type_name("N");
  app.add_flag("--no-cache", arguments->no_cache,
               "Neither read nor write the routes kept beside the scenario, SCENARIO.routes");
  app.add_flag("--json", arguments->json, "Print one JSON object (docs/cli.md) instead of text");
  app.footer(
      "Example:\n  linewright routes scenarios/teaching/kitting_cell.yaml --svg out/routes.svg");
  return [arguments] { return show(*arguments); };
}

}  // namespace linewright::cli
