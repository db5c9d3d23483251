#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>

#include "common.hpp"
#include "linewright/base/diagnostic.hpp"
#include "linewright/base/files.hpp"
#include "linewright/evaluation/routes_svg.hpp"
#include "linewright/scenario/load.hpp"
#include "route_report.hpp"

namespace linewright::cli {
namespace {

struct RoutesArguments {
  std::string scenario;
  std::string svg;
  std::vector<std::string> starts;
  std::vector<std::string> kinds;
  std::size_t threads = 0;
  bool no_cache = false;
  bool json = false;
};

/// Ctrl-C while the routes are planned ends in a ScenarioError, too.
Scenario load_for_routes(const RoutesArguments& arguments) {
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

int interrupted_code() {
  report("interrupted while planning the routes: nothing was written");
  return kInterrupted;
}

/// Before anything is planned, which may take long.
void check_picture(const RoutesArguments& arguments) {
  if (arguments.svg.empty() && !arguments.starts.empty()) {
    throw ScenarioError({}, "--start chooses what the picture shows, but no picture is written",
                        "add --svg FILE.svg");
  }
  if (!arguments.svg.empty() && !arguments.svg.ends_with(".svg")) {
    throw ScenarioError(arguments.svg, "the picture of the routes is an SVG file",
                        "name a file that ends in .svg");
  }
}

int show(const RoutesArguments& arguments) {
  check_picture(arguments);
  Scenario scenario;
  try {
    scenario = load_for_routes(arguments);
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
  if (!arguments.svg.empty()) write_file(arguments.svg, routes_svg(scenario, panels));
  if (arguments.json) {
    nlohmann::ordered_json object = routes_json(scenario, *times);
    if (!arguments.svg.empty()) object["svg"] = arguments.svg;
    print(object.dump(2) + "\n");
    return kOk;
  }
  print(routes_text(scenario, *times) +
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
