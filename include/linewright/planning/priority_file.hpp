#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "linewright/base/id.hpp"
#include "linewright/line/line_model.hpp"
#include "linewright/planning/tune_priority.hpp"

namespace linewright {

/// Where the tuned order of a scenario is kept: beside it, `NAME.priority` for `NAME.yaml`
/// (docs/formats/priority.md).
[[nodiscard]] std::string priority_file_of(const std::string& scenario_file);

/// A tuned order and the allocator that it was tuned for.
struct PriorityEntry {
  std::string allocator;
  TunedPriority tuned;
};

/// The text of such a file. `scenario_hash`: Scenario::content_hash.
[[nodiscard]] std::string priority_text(const LineModel& line, std::uint64_t scenario_hash,
                                        const std::vector<PriorityEntry>& entries);

/// What such a text holds, at least one entry. Throws ScenarioError when it is none, is of another
/// scenario or another version of this one, or names other tasks than the line has; `file` is only
/// named.
[[nodiscard]] std::vector<PriorityEntry> parse_priority_file(std::string_view text,
                                                             const std::string& file,
                                                             const LineModel& line,
                                                             std::uint64_t scenario_hash);

/// Which tuned order is wanted.
struct PriorityKey {
  std::string scenario_file;
  std::uint64_t scenario_hash = 0;
  std::string allocator;
};

/// The order tuned for that allocator, or the first of the scenario when none is. Throws
/// ScenarioError as parse_priority_file does, and when there is no such file or no scenario file
/// (empty).
[[nodiscard]] std::vector<TaskId> load_priority(const LineModel& line, const PriorityKey& key);

/// The same, none where load_priority would throw: for those who can do without.
[[nodiscard]] std::optional<std::vector<TaskId>> find_priority(const LineModel& line,
                                                               const PriorityKey& key);

}  // namespace linewright
