#include "build_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <variant>

#include "condition_parser.hpp"

namespace linewright::loading {
namespace {

/// The section in which `name` exists although another one was meant.
std::optional<Section> elsewhere(const NameTable& names, std::string_view name) {
  for (std::size_t i = 0; i < kSections; ++i) {
    const auto section = static_cast<Section>(i);
    if (section != Section::kMilestones && names.find(section, name)) return section;
  }
  return std::nullopt;
}

struct Attribute {
  Section section;
  std::string_view word;  ///< empty: the bare name
  VariableKind kind;
};

constexpr std::array<Attribute, 12> kVariables = {{
    {Section::kPlaces, "", VariableKind::kPlaceCount},
    {Section::kPlaces, "available", VariableKind::kPlaceAvailable},
    {Section::kPlaces, "room", VariableKind::kPlaceRoom},
    {Section::kPlaces, "occupied", VariableKind::kPlaceOccupied},
    {Section::kMachines, "free", VariableKind::kMachineFree},
    {Section::kMachines, "working", VariableKind::kMachineWorking},
    {Section::kOperations, "running", VariableKind::kOperationRunning},
    {Section::kOperations, "done", VariableKind::kOperationDone},
    {Section::kTasks, "running", VariableKind::kTaskRunning},
    {Section::kTasks, "done", VariableKind::kTaskDone},
    {Section::kWorkers, "free", VariableKind::kWorkersFree},
    {Section::kCarriers, "free", VariableKind::kCarriersFree},
}};

/// "press.free or press.working"
std::string variables_of(Section section, std::string_view name) {
  std::string list;
  for (const Attribute& attribute : kVariables) {
    if (attribute.section != section) continue;
    const std::string dotted =
        attribute.word.empty() ? std::string(name) : fmt::format("{}.{}", name, attribute.word);
    list += (list.empty() ? "" : " or ") + dotted;
  }
  return list;
}

using LookupResult = std::variant<Variable, ConditionFault>;

/// All names that a condition may start with.
std::vector<std::string> names_in_conditions(const NameTable& names) {
  std::vector<std::string> known = {"order"};
  for (std::size_t i = 0; i < kSections; ++i) {
    const auto section = static_cast<Section>(i);
    if (section == Section::kStations || section == Section::kMilestones ||
        section == Section::kZones) {
      continue;
    }
    const auto& more = names.names(section);
    known.insert(known.end(), more.begin(), more.end());
  }
  return known;
}

LookupResult look_up(const BuildState& state, std::string_view text) {
  const NameTable& names = state.names;
  if (text == "order") return Variable{VariableKind::kOrder, 0};
  std::string_view name = text;
  std::string_view word;
  const std::size_t dot = text.rfind('.');
  if (dot != std::string_view::npos && is_attribute(text.substr(dot + 1))) {
    name = text.substr(0, dot);
    word = text.substr(dot + 1);
  }
  const std::string_view whole = name;
  auto found = names.find_in_conditions(name);
  if (!found && dot != std::string_view::npos && word.empty()) {
    // `press.idle`: nothing of that name, but of the name before the dot.
    name = text.substr(0, dot);
    word = text.substr(dot + 1);
    found = names.find_in_conditions(name);
  }
  if (!found) {
    return ConditionFault{fmt::format("there is nothing called {}", in_quotes(whole)),
                          state.problems.hint(whole, [&] { return names_in_conditions(names); })};
  }
  for (const Attribute& attribute : kVariables) {
    if (attribute.section != found->section || attribute.word != word) continue;
    const bool is_berth = names.node(found->section, found->id).find("carrier") != nullptr;
    if (attribute.kind == VariableKind::kPlaceOccupied && !is_berth) {
      return ConditionFault{fmt::format("{} is no berth", in_quotes(name)),
                            "only a place with 'carrier' can be occupied"};
    }
    return Variable{attribute.kind, found->id};
  }
  const std::string fault = word.empty() ? "has no number of its own"
                                         : fmt::format("has no attribute {}", in_quotes(word));
  return ConditionFault{
      fmt::format("{} {} {}", section_noun(found->section), in_quotes(name), fault),
      "write " + variables_of(found->section, name)};
}

std::optional<Condition> parse_at(BuildState& state, const SourceNode& node,
                                  const std::string& subject) {
  const VariableLookup lookup = [&state](std::string_view name) { return look_up(state, name); };
  auto parsed = parse_condition(node.text, lookup);
  if (auto* condition = std::get_if<Condition>(&parsed)) return std::move(*condition);
  const auto& fault = std::get<ConditionFault>(parsed);
  state.problems.error(
      node.mark, fmt::format("{}: condition {}: {}", subject, in_quotes(node.text), fault.message),
      fault.hint);
  return std::nullopt;
}

}  // namespace

BuildState::BuildState(const SourceNode& checked_root, Problems& found)
    : problems(found), root(checked_root), names(checked_root, found) {
  for (std::size_t i = 0; i < kSections; ++i) {
    sound[i].assign(names.size(static_cast<Section>(i)), true);
  }
}

bool BuildState::all_sound(Section section) const {
  const auto& flags = sound[static_cast<std::size_t>(section)];
  return std::find(flags.begin(), flags.end(), false) == flags.end();
}

void BuildState::each(Section section,
                      const std::function<void(std::int32_t id, const SourceNode& node)>& build) {
  for (std::size_t i = 0; i < names.size(section); ++i) {
    const auto id = static_cast<std::int32_t>(i);
    const std::size_t before = problems.count();
    build(id, names.node(section, id));
    sound[static_cast<std::size_t>(section)][i] =
        problems.count() == before && names.node(section, id).sound;
  }
}

std::optional<std::int32_t> reference(BuildState& state, Section section, const std::string& name,
                                      SourceMark mark, const std::string& title) {
  if (const auto id = state.names.find(section, name)) return id;
  const std::string wanted = with_article(section);
  if (const auto other = elsewhere(state.names, name)) {
    state.problems.error(
        mark,
        fmt::format("{}: {} is {}, not {}", title, in_quotes(name), with_article(*other), wanted),
        state.problems.hint(name, state.names.names(section)));
    return std::nullopt;
  }
  std::string hint = state.problems.hint(name, state.names.names(section));
  if (hint.empty()) hint = fmt::format("the file has no '{}' yet", section_key(section));
  state.problems.error(
      mark, fmt::format("{}: there is no {} {}", title, section_noun(section), in_quotes(name)),
      hint);
  return std::nullopt;
}

std::optional<std::int32_t> reference(BuildState& state, Section section, const SourceNode& node,
                                      const std::string& title) {
  if (!node.is_scalar()) return std::nullopt;
  return reference(state, section, node.text, node.mark, title);
}

Condition condition_at(BuildState& state, const SourceNode& mapping, std::string_view key,
                       const std::string& title) {
  const SourceNode* node = mapping.find(key);
  if (node == nullptr) return {};
  const std::string subject = fmt::format("{}: '{}'", title, key);
  if (node->is_scalar()) return parse_at(state, *node, subject).value_or(Condition{});
  Condition result;
  for (const SourceNode& item : node->items) {
    if (item.is_broken()) continue;
    const auto condition = parse_at(state, item, subject);
    if (!condition) continue;
    auto joined = both(std::move(result), *condition);
    if (!joined) {
      state.problems.error(item.mark,
                           fmt::format("{}: the list of conditions is too long", subject),
                           "split the operation or task in two");
      return {};
    }
    result = std::move(*joined);
  }
  return result;
}

}  // namespace linewright::loading
