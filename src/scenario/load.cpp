#include "linewright/scenario/load.hpp"

#include <algorithm>
#include <utility>

#include "build_state.hpp"
#include "linewright/base/hash.hpp"
#include "linewright/scenario/shape_check.hpp"
#include "linewright/scenario/source_files.hpp"
#include "linewright/scenario/yaml_reader.hpp"
#include "scenario_shape.hpp"
#include "templates.hpp"

namespace linewright {
namespace {

using loading::BuildState;
using loading::Problems;
using loading::SourceEntry;
using loading::SourceNode;

void build(BuildState& state) {
  loading::build_workers(state);
  loading::build_stations(state);
  loading::build_places(state);
  loading::build_machines(state);
  loading::build_operations(state);
  loading::build_tasks(state);
  loading::build_run(state);
  loading::build_map(state);
  loading::build_zones(state);
}

void check(const BuildState& state) {
  loading::check_workers(state);
  loading::check_places(state);
  loading::check_machines(state);
  loading::check_operations(state);
  loading::check_crews(state);
  loading::check_tasks(state);
  loading::check_order(state);
}

/// The hash of what a run depends on. Floor areas of machines are only drawn: with or without them,
/// policies, priorities, caches and logs of a scenario stay valid.
std::uint64_t hash_of_run(SourceNode root) {
  if (SourceNode* machines = root.find("machines")) {
    for (SourceEntry& machine : machines->entries) {
      std::erase_if(machine.value.entries,
                    [](const SourceEntry& entry) { return entry.key == "area_m"; });
    }
  }
  return loading::content_hash(root);
}

/// From the merged tree to the scenario. Names come first and everything that needs the whole line
/// last, so that the order in the file does not matter.
Scenario resolve(SourceNode root, const std::string& file, bool may_read_files,
                 const LoadOptions& options, Problems& problems) {
  std::uint64_t hash = hash_of_run(root);
  loading::expand_templates(root, problems);
  loading::check_shape(root, loading::scenario_shape(), problems);
  BuildState state(root, problems);
  state.may_read_files = may_read_files;
  state.options = options;
  state.scenario.file = file;
  if (may_read_files && options.route_cache) state.route_cache_file = file + ".routes";
  build(state);
  check(state);
  loading::build_travel(state);
  problems.throw_if_any();
  loading::store_routes(state);
  if (state.map_hash) hash = hash_of(std::to_string(*state.map_hash), hash);
  state.scenario.content_hash = hash;
  return std::move(state.scenario);
}

}  // namespace

Scenario load_scenario(const std::string& file, const LoadOptions& options) {
  Problems problems;
  SourceNode root = loading::read_files(file, problems);
  if (root.is_broken()) problems.throw_if_any();
  return resolve(std::move(root), file, true, options, problems);
}

Scenario load_scenario_text(std::string_view text, const std::string& file_name,
                            const LoadOptions& options) {
  Problems problems;
  SourceNode root = loading::read_yaml(text, problems.add_file(file_name), problems);
  if (root.is_broken()) problems.throw_if_any();
  if (const SourceNode* extends = root.find("extends")) {
    problems.error(extends->mark, "'extends' needs a file, and this text has no folder",
                   "load the scenario from a file");
  }
  return resolve(std::move(root), file_name, false, options, problems);
}

}  // namespace linewright
