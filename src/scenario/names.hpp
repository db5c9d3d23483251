#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "linewright/scenario/source_node.hpp"

namespace linewright::loading {

inline constexpr std::size_t kMaxNameLength = 100;

/// The sections of a scenario that hold named entries.
enum class Section : std::uint8_t {
  kWorkers,
  kCarriers,
  kStations,
  kPlaces,
  kMachines,
  kOperations,
  kTasks,
  kMilestones,
  kZones,
};
inline constexpr std::size_t kSections = 9;

/// "operations", the key in the file.
[[nodiscard]] const char* section_key(Section section);
/// "operation", what one entry is called in messages.
[[nodiscard]] const char* section_noun(Section section);
/// "an operation"
[[nodiscard]] std::string with_article(Section section);

/// All names of the file and the ids they get, collected before anything is resolved, so that the
/// order in the file does not matter.
class NameTable {
 public:
  /// `root` has been checked against the key tables. Reports names that are malformed, reserved or
  /// used for two things.
  NameTable(const SourceNode& root, Problems& problems);

  [[nodiscard]] std::size_t size(Section section) const { return entries(section).size(); }
  [[nodiscard]] std::optional<std::int32_t> find(Section section, std::string_view name) const;

  struct Found {
    Section section;
    std::int32_t id;
  };
  /// What a condition may mean by `name`: anything but stations, milestones and zones.
  [[nodiscard]] std::optional<Found> find_in_conditions(std::string_view name) const;

  /// Everything below is by id. Tasks have their ids in the order of their numbers, all others in
  /// file order.
  [[nodiscard]] const std::vector<std::string>& names(Section section) const;
  [[nodiscard]] const SourceNode& node(Section section, std::int32_t id) const;
  [[nodiscard]] SourceMark mark(Section section, std::int32_t id) const;
  /// "operation 'weld'"
  [[nodiscard]] std::string title(Section section, std::int32_t id) const;
  /// Of tasks only.
  [[nodiscard]] std::int32_t task_number(std::int32_t id) const;

 private:
  struct Index {
    std::vector<const SourceEntry*> entries;
    std::vector<std::string> names;
    std::map<std::string, std::int32_t, std::less<>> ids;
  };

  [[nodiscard]] const std::vector<const SourceEntry*>& entries(Section section) const {
    return indices_[static_cast<std::size_t>(section)].entries;
  }
  void collect(Section section, const SourceNode& root, Problems& problems);
  void order_tasks(Problems& problems);
  void check_shared_names(Problems& problems) const;

  std::array<Index, kSections> indices_;
  std::vector<std::int32_t> task_numbers_;
};

/// What is wrong with `name` as a name, or nothing.
[[nodiscard]] std::optional<std::string> name_fault(std::string_view name);

/// The part behind the last dot of a name in a condition: `room` in `table.room`.
[[nodiscard]] bool is_attribute(std::string_view word);

}  // namespace linewright::loading
