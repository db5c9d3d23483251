#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "linewright/scenario/load.hpp"
#include "linewright/scenario/scenario.hpp"
#include "linewright/scenario/source_node.hpp"
#include "names.hpp"

namespace linewright::loading {

/// Where the actions of a task were written, in the shape of Task::steps.
struct TaskSource {
  std::vector<std::vector<std::vector<SourceMark>>> actions;  ///< [step][sequence][action]
};

/// What the passes that turn the checked tree into a scenario work on.
struct BuildState {
  Problems& problems;
  const SourceNode& root;  ///< checked against the key tables
  NameTable names;
  Scenario scenario;
  LoadOptions options;
  std::string route_cache_file;  ///< empty: routes are not kept
  std::string routes_to_store;   ///< bytes for that file, once the scenario has turned out sound
  bool may_read_files = true;    ///< false: the scenario is a text without a folder
  std::optional<std::uint64_t> map_hash;  ///< of the map file's content, where there is one
  std::vector<TaskSource> task_sources;   ///< by task id
  std::array<std::vector<bool>, kSections> sound;  ///< by section and id: nothing wrong reported

  BuildState(const SourceNode& checked_root, Problems& found);

  [[nodiscard]] LineModel& line() { return scenario.line; }
  [[nodiscard]] const LineModel& line() const { return scenario.line; }

  /// Calls `build` for every entry in id order and notes for which of them problems were found.
  void each(Section section,
            const std::function<void(std::int32_t id, const SourceNode& node)>& build);
  [[nodiscard]] bool is_sound(Section section, std::int32_t id) const {
    return sound[static_cast<std::size_t>(section)][static_cast<std::size_t>(id)];
  }
  [[nodiscard]] bool all_sound(Section section) const;
};

/// The id that a scalar names; reports when there is none. `title` is the entry that names it.
[[nodiscard]] std::optional<std::int32_t> reference(BuildState& state, Section section,
                                                    const SourceNode& node,
                                                    const std::string& title);

/// The same for the key of an entry.
[[nodiscard]] std::optional<std::int32_t> reference(BuildState& state, Section section,
                                                    const std::string& name, SourceMark mark,
                                                    const std::string& title);

/// The same for an optional key of `mapping`, as a typed id.
template <class IdType>
[[nodiscard]] std::optional<IdType> reference_at(BuildState& state, Section section,
                                                 const SourceNode& mapping, std::string_view key,
                                                 const std::string& title) {
  const SourceNode* node = mapping.find(key);
  if (node == nullptr) return std::nullopt;
  const auto id = reference(state, section, *node, title);
  return id ? std::optional(IdType(*id)) : std::nullopt;
}

/// The condition under `key` of `mapping`; always true when it is absent or wrong.
[[nodiscard]] Condition condition_at(BuildState& state, const SourceNode& mapping,
                                     std::string_view key, const std::string& title);

// The passes, in this order. Each fills its part of state.scenario.
void build_workers(BuildState& state);
void build_stations(BuildState& state);
void build_places(BuildState& state);
void build_machines(BuildState& state);
void build_operations(BuildState& state);
void build_tasks(BuildState& state);
void build_run(BuildState& state);  ///< order, horizon, milestones and the rest
void build_map(BuildState& state);
void build_zones(BuildState& state);

// Everything that needs the whole line. Entries with problems of their own are left out.
void check_workers(const BuildState& state);
void check_places(const BuildState& state);
void check_machines(const BuildState& state);
void check_operations(const BuildState& state);
void check_crews(const BuildState& state);
void check_tasks(const BuildState& state);  ///< what the crews do, step by step
void check_order(const BuildState& state);

/// Ways between the stations, for every kind of worker; reports ways that are needed and not there.
void build_travel(BuildState& state);

/// Keeps newly planned routes for the next time; a file that cannot be written is a warning.
void store_routes(BuildState& state);

}  // namespace linewright::loading
