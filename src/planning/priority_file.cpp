#include "linewright/planning/priority_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "linewright/base/diagnostic.hpp"
#include "linewright/base/files.hpp"

namespace linewright {
namespace {

using Json = nlohmann::ordered_json;
using Keys = std::vector<std::string>;

constexpr const char* kFormat = "priority/1";
constexpr const char* kTuneHint = "write a new one with linewright tune-priority";
constexpr std::size_t kMostBytes = std::size_t{1} << 20;

const Keys& file_keys() {
  static const Keys keys{"format", "scenario", "scenario_hash", "orders"};
  return keys;
}

const Keys& entry_keys() {
  static const Keys keys{"allocator", "order", "makespan", "success_rate", "runs"};
  return keys;
}

std::string hash_text(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

/// Reads the parts of one file, and names it when they are wrong.
class Reader {
 public:
  Reader(const LineModel& line, const std::string& file) : line_(line), file_(file) {}

  [[noreturn]] void refuse(const std::string& what, const std::string& hint = kTuneHint) const {
    throw ScenarioError(file_, what, hint);
  }

  void allow_only(const Json& object, const Keys& keys) const {
    if (!object.is_object()) refuse("this is no priority file");
    for (const auto& item : object.items()) {
      if (std::find(keys.begin(), keys.end(), item.key()) != keys.end()) continue;
      refuse(fmt::format("unknown key {}", in_quotes(item.key())), name_hint(item.key(), keys));
    }
  }

  [[nodiscard]] std::string text_of(const Json& json, const char* key) const {
    const auto found = json.find(key);
    if (found == json.end() || !found->is_string()) {
      refuse(fmt::format("'{}' is missing or no text", key));
    }
    return found->get<std::string>();
  }

  [[nodiscard]] const Json& list_of(const Json& json, const char* key) const {
    const auto found = json.find(key);
    if (found == json.end() || !found->is_array()) {
      refuse(fmt::format("'{}' is missing or no list", key));
    }
    return *found;
  }

  [[nodiscard]] PriorityEntry entry(const Json& json) const {
    allow_only(json, entry_keys());
    PriorityEntry entry;
    entry.allocator = text_of(json, "allocator");
    for (const Json& name : list_of(json, "order")) add_task(name, entry.tuned.order);
    if (entry.tuned.order.size() != line_.tasks.size()) refuse("'order' does not name every task");
    entry.tuned.makespan = number_of(json, "makespan");
    entry.tuned.success_rate = number_of(json, "success_rate");
    entry.tuned.runs = static_cast<std::size_t>(std::clamp(number_of(json, "runs"), 0.0, 1e15));
    return entry;
  }

 private:
  void add_task(const Json& json, std::vector<TaskId>& order) const {
    if (!json.is_string()) refuse("'order' holds what is no name");
    const auto name = json.get<std::string>();
    Keys names;
    for (const Task& task : line_.tasks) names.push_back(task.name);
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
      refuse(fmt::format("line '{}' has no task {}", line_.name, in_quotes(name)),
             name_hint(name, names));
    }
    const TaskId task(static_cast<std::size_t>(found - names.begin()));
    if (std::find(order.begin(), order.end(), task) != order.end()) {
      refuse(fmt::format("'order' names {} twice", in_quotes(name)));
    }
    order.push_back(task);
  }

  [[nodiscard]] double number_of(const Json& json, const char* key) const {
    const auto found = json.find(key);
    if (found == json.end()) return 0.0;
    if (!found->is_number()) refuse(fmt::format("'{}' is no number", key));
    return found->get<double>();
  }

  const LineModel& line_;
  const std::string& file_;
};

}  // namespace

std::string priority_file_of(const std::string& scenario_file) {
  return std::filesystem::path(scenario_file).replace_extension(".priority").string();
}

std::string priority_text(const LineModel& line, std::uint64_t scenario_hash,
                          const std::vector<PriorityEntry>& entries) {
  Json json{{"format", kFormat},
            {"scenario", line.name},
            {"scenario_hash", hash_text(scenario_hash)},
            {"orders", Json::array()}};
  for (const PriorityEntry& entry : entries) {
    Json order = Json::array();
    for (const TaskId task : entry.tuned.order) order.push_back(line.tasks[task.index()].name);
    json["orders"].push_back({{"allocator", entry.allocator},
                              {"order", std::move(order)},
                              {"makespan", entry.tuned.makespan},
                              {"success_rate", entry.tuned.success_rate},
                              {"runs", entry.tuned.runs}});
  }
  return json.dump(2) + "\n";
}

std::vector<PriorityEntry> parse_priority_file(std::string_view text, const std::string& file,
                                               const LineModel& line, std::uint64_t scenario_hash) {
  const Reader reader(line, file);
  const Json json = Json::parse(text, nullptr, false);
  reader.allow_only(json, file_keys());
  if (reader.text_of(json, "format") != kFormat) {
    reader.refuse(fmt::format("the format is not '{}'", kFormat));
  }
  if (reader.text_of(json, "scenario_hash") != hash_text(scenario_hash)) {
    reader.refuse("was tuned for another scenario, or for another version of this one");
  }
  std::vector<PriorityEntry> entries;
  for (const Json& entry : reader.list_of(json, "orders")) entries.push_back(reader.entry(entry));
  if (entries.empty()) reader.refuse("'orders' holds none");
  return entries;
}

std::vector<TaskId> load_priority(const LineModel& line, const PriorityKey& key) {
  if (key.scenario_file.empty()) {
    throw ScenarioError({}, "priority:tuned needs a scenario that was read from a file",
                        "give the list itself: priority:3,1,2");
  }
  const std::string file = priority_file_of(key.scenario_file);
  std::string reason;
  const auto text = read_file(file, kMostBytes, reason);
  if (!text || text->size() > kMostBytes) {
    throw ScenarioError(file, text ? "is too long for a priority file" : reason,
                        fmt::format("there is no tuned priority for this scenario yet: run "
                                    "linewright tune-priority {}",
                                    key.scenario_file));
  }
  const auto entries = parse_priority_file(*text, file, line, key.scenario_hash);
  const auto tuned_for =
      std::find_if(entries.begin(), entries.end(),
                   [&](const PriorityEntry& entry) { return entry.allocator == key.allocator; });
  return (tuned_for == entries.end() ? entries.front() : *tuned_for).tuned.order;
}

std::optional<std::vector<TaskId>> find_priority(const LineModel& line, const PriorityKey& key) {
  try {
    return load_priority(line, key);
  } catch (const ScenarioError&) {
    return std::nullopt;
  }
}

}  // namespace linewright
