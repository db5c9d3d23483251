#include "names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <numeric>
#include <utility>

#include "linewright/scenario/values.hpp"
#include "linewright/scenario/yaml_reader.hpp"

namespace linewright::loading {
namespace {

constexpr std::array<const char*, kSections> kKeys = {"workers", "carriers",   "stations",
                                                      "places",  "machines",   "operations",
                                                      "tasks",   "milestones", "zones"};
constexpr std::array<const char*, kSections> kNouns = {
    "worker", "carrier", "station", "place", "machine", "operation", "task", "milestone", "zone"};

/// Conditions name all of these, so no two entries in them may share a name.
constexpr std::array kInConditions = {Section::kWorkers,  Section::kCarriers,   Section::kPlaces,
                                      Section::kMachines, Section::kOperations, Section::kTasks};

/// Words that mean something else where a name may stand.
constexpr std::array<std::string_view, 11> kReserved = {
    "order", "and",   "or",  "not",   "true",          "false",
    "null",  "empty", "any", "slots", "random_station"};
constexpr std::array<std::string_view, 7> kAttributes = {"available", "room",    "occupied", "free",
                                                         "working",   "running", "done"};

bool is_name_part(std::string_view part) {
  return !part.empty() && std::all_of(part.begin(), part.end(), [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
  });
}

bool is_name_shaped(std::string_view name) {
  if (name.empty() || std::isalpha(static_cast<unsigned char>(name.front())) == 0) return false;
  while (true) {
    const std::size_t dot = name.find('.');
    if (!is_name_part(name.substr(0, dot))) return false;
    if (dot == std::string_view::npos) return true;
    name.remove_prefix(dot + 1);
  }
}

}  // namespace

const char* section_key(Section section) { return kKeys[static_cast<std::size_t>(section)]; }
const char* section_noun(Section section) { return kNouns[static_cast<std::size_t>(section)]; }

std::string with_article(Section section) {
  const std::string noun = section_noun(section);
  return (noun.front() == 'o' ? "an " : "a ") + noun;
}

bool is_attribute(std::string_view word) {
  return std::find(kAttributes.begin(), kAttributes.end(), word) != kAttributes.end();
}

std::optional<std::string> name_fault(std::string_view name) {
  if (name.size() > kMaxNameLength) return fmt::format("longer than {} characters", kMaxNameLength);
  if (!is_name_shaped(name))
    return "names start with a letter and consist of letters, digits, _ and .";
  if (is_banned_word(name)) return "YAML 1.1 reads it as a boolean";
  if (std::find(kReserved.begin(), kReserved.end(), name) != kReserved.end()) {
    return "the word has a meaning of its own";
  }
  const std::size_t dot = name.rfind('.');
  if (dot != std::string_view::npos && is_attribute(name.substr(dot + 1))) {
    return fmt::format("conditions would read '.{}' as an attribute", name.substr(dot + 1));
  }
  return std::nullopt;
}

NameTable::NameTable(const SourceNode& root, Problems& problems) {
  for (std::size_t i = 0; i < kSections; ++i) collect(static_cast<Section>(i), root, problems);
  order_tasks(problems);
  for (Index& index : indices_) {
    for (std::size_t i = 0; i < index.entries.size(); ++i) {
      index.names.push_back(index.entries[i]->key);
      index.ids.emplace(index.entries[i]->key, static_cast<std::int32_t>(i));
    }
  }
  check_shared_names(problems);
}

void NameTable::collect(Section section, const SourceNode& root, Problems& problems) {
  const SourceNode* node = root.find(section_key(section));
  if (node == nullptr) return;
  for (const SourceEntry& entry : node->entries) {
    // A banned word was reported when the key was read.
    const auto fault = is_banned_word(entry.key) ? std::nullopt : name_fault(entry.key);
    if (fault) {
      problems.error(entry.mark,
                     fmt::format("{} cannot be the name of {}: {}", in_quotes(entry.key),
                                 with_article(section), *fault),
                     "choose another name");
    }
    indices_[static_cast<std::size_t>(section)].entries.push_back(&entry);
  }
}

void NameTable::order_tasks(Problems& problems) {
  auto& tasks = indices_[static_cast<std::size_t>(Section::kTasks)].entries;
  std::vector<std::pair<std::int32_t, const SourceEntry*>> numbered;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    numbered.emplace_back(integer_or(tasks[i]->value, "number", static_cast<std::int32_t>(i) + 1),
                          tasks[i]);
  }
  std::stable_sort(numbered.begin(), numbered.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  for (std::size_t i = 0; i < numbered.size(); ++i) {
    const auto& [number, entry] = numbered[i];
    tasks[i] = entry;
    task_numbers_.push_back(number);
    if (i > 0 && task_numbers_[i - 1] == number) {
      problems.error(
          mark_of(entry->value, "number"),
          fmt::format("task {}: number {} is also that of task {}", in_quotes(entry->key), number,
                      in_quotes(numbered[i - 1].second->key)),
          "without 'number' a task has its place in the file; give all of them a number");
    }
  }
}

void NameTable::check_shared_names(Problems& problems) const {
  std::map<std::string_view, Section> seen;
  for (const Section section : kInConditions) {
    for (const SourceEntry* entry : entries(section)) {
      const auto [first, is_new] = seen.try_emplace(entry->key, section);
      if (is_new) continue;
      problems.error(entry->mark,
                     fmt::format("{} is the name of {} and of {}", in_quotes(entry->key),
                                 with_article(first->second), with_article(section)),
                     "conditions could mean either; rename one of them");
    }
  }
}

std::optional<std::int32_t> NameTable::find(Section section, std::string_view name) const {
  const auto& ids = indices_[static_cast<std::size_t>(section)].ids;
  const auto found = ids.find(name);
  return found == ids.end() ? std::nullopt : std::optional(found->second);
}

std::optional<NameTable::Found> NameTable::find_in_conditions(std::string_view name) const {
  for (const Section section : kInConditions) {
    if (const auto id = find(section, name)) return Found{section, *id};
  }
  return std::nullopt;
}

const std::vector<std::string>& NameTable::names(Section section) const {
  return indices_[static_cast<std::size_t>(section)].names;
}

const SourceNode& NameTable::node(Section section, std::int32_t id) const {
  return entries(section)[static_cast<std::size_t>(id)]->value;
}

SourceMark NameTable::mark(Section section, std::int32_t id) const {
  return entries(section)[static_cast<std::size_t>(id)]->mark;
}

std::string NameTable::title(Section section, std::int32_t id) const {
  return fmt::format("{} {}", section_noun(section),
                     in_quotes(names(section)[static_cast<std::size_t>(id)]));
}

std::int32_t NameTable::task_number(std::int32_t id) const {
  return task_numbers_[static_cast<std::size_t>(id)];
}

}  // namespace linewright::loading
