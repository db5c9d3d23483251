#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "build_state.hpp"
#include "limits.hpp"
#include "linewright/scenario/values.hpp"

namespace linewright::loading {
namespace {

class TaskBuilder {
 public:
  TaskBuilder(BuildState& state, std::int32_t id, const SourceNode& node)
      : state_(state), node_(node), title_(state.names.title(Section::kTasks, id)) {
    task_.name = state.names.names(Section::kTasks)[static_cast<std::size_t>(id)];
    task_.number = state.names.task_number(id);
  }

  void build() {
    build_crew();
    task_.when = condition_at(state_, node_, "when", title_);
    task_.max_running = integer_or(node_, "max_running", 1);
    build_reserves();
    if (const SourceNode* steps = node_.find("steps")) {
      for (const SourceNode& step : steps->items) build_step(step);
    }
    state_.line().tasks.push_back(std::move(task_));
    state_.task_sources.push_back(std::move(source_));
  }

 private:
  void error(SourceMark mark, const std::string& message, std::string hint = {}) {
    state_.problems.error(mark, fmt::format("{}: {}", title_, message), std::move(hint));
  }

  void build_crew() {
    const SourceNode* crew = node_.find("crew");
    if (crew == nullptr) return;
    for (const SourceEntry& entry : crew->entries) {
      if (const auto carrier = state_.names.find(Section::kCarriers, entry.key)) {
        add_carrier(entry, CarrierKindId(*carrier));
      } else if (const auto worker = member_kind(entry)) {
        add_workers(entry, WorkerKindId(*worker));
      }
    }
    if (task_.crew.size() > static_cast<std::size_t>(kMostCrew)) {
      error(crew->mark, fmt::format("a crew of {}, more than {}", task_.crew.size(), kMostCrew),
            "split the task");
    }
  }

  std::optional<std::int32_t> member_kind(const SourceEntry& entry) {
    if (const auto worker = state_.names.find(Section::kWorkers, entry.key)) return worker;
    const auto known = [this] {
      std::vector<std::string> names = state_.names.names(Section::kWorkers);
      const auto& carriers = state_.names.names(Section::kCarriers);
      names.insert(names.end(), carriers.begin(), carriers.end());
      return names;
    };
    error(entry.mark, fmt::format("there is no worker or carrier {}", in_quotes(entry.key)),
          state_.problems.hint(entry.key, known));
    return std::nullopt;
  }

  void add_workers(const SourceEntry& entry, WorkerKindId kind) {
    std::int32_t count = 1;
    bool late = false;
    if (entry.value.is_mapping()) {
      count = integer_or(entry.value, "count", 1);
      late = text_or(entry.value, "join", "at_start") == "late";
    } else if (const auto number = parse_integer(entry.value.text)) {
      count = static_cast<std::int32_t>(*number);
    } else if (!entry.value.is_broken()) {
      error(entry.value.mark,
            fmt::format("{} is a kind of worker, so {} must be a number", in_quotes(entry.key),
                        in_quotes(entry.value.text)),
            fmt::format("write {}: 1", entry.key));
    }
    for (std::int32_t i = 0; i < count; ++i) {
      CrewSlot slot;
      slot.role = entry.key;
      slot.worker = kind;
      slot.join_late = late;
      task_.crew.push_back(std::move(slot));
    }
  }

  void add_carrier(const SourceEntry& entry, CarrierKindId kind) {
    CrewSlot slot;
    slot.role = entry.key;
    slot.carrier = kind;
    const SourceNode& wanted = entry.value;
    if (wanted.is_scalar() && wanted.text == "any") {
      slot.wanted = CarrierWanted::kAny;
    } else if (wanted.is_scalar() && wanted.text != "empty" && !parse_integer(wanted.text)) {
      slot.wanted = CarrierWanted::kBerth;
      slot.berth = PlaceId(reference(state_, Section::kPlaces, wanted, title_).value_or(0));
    } else if (!wanted.is_broken() && wanted.text != "empty") {
      error(wanted.mark,
            fmt::format("{} is a carrier, of which a task has one", in_quotes(entry.key)),
            fmt::format("write {}: empty, {}: any, or the name of a berth", entry.key, entry.key));
    }
    task_.crew.push_back(std::move(slot));
  }

  void build_reserves() {
    const SourceNode* reserves = node_.find("reserves");
    if (reserves == nullptr) return;
    if (!reserves->is_list()) return add_reservation(*reserves);
    for (const SourceNode& item : reserves->items) add_reservation(item);
    if (task_.reserves.size() > kMostReserves) {
      error(reserves->mark,
            fmt::format("{} reservations, more than {}", task_.reserves.size(), kMostReserves),
            "a task that needs so many is better split");
      task_.reserves.resize(kMostReserves);
    }
  }

  void add_reservation(const SourceNode& node) {
    const bool room = node.is_mapping();
    const SourceNode* place = room ? node.find("room") : &node;
    if (place == nullptr) return;
    const auto id = reference(state_, Section::kPlaces, *place, title_);
    if (id) task_.reserves.push_back({PlaceId(*id), room});
  }

  void build_step(const SourceNode& node) {
    std::vector<std::pair<ActorSequence, std::vector<SourceMark>>> sequences;
    for (const SourceEntry& entry : node.entries) {
      const std::vector<std::size_t> slots = actor_slots(entry);
      if (slots.empty()) continue;
      auto [actions, marks] = build_actions(entry.value);
      for (const std::size_t slot : slots) sequences.push_back({{slot, actions}, marks});
    }
    std::stable_sort(sequences.begin(), sequences.end(),
                     [](const auto& a, const auto& b) { return a.first.slot < b.first.slot; });
    Step step;
    source_.actions.emplace_back();
    for (auto& [sequence, marks] : sequences) {
      step.sequences.push_back(std::move(sequence));
      source_.actions.back().push_back(std::move(marks));
    }
    task_.steps.push_back(std::move(step));
    if (node.is_mapping() && node.entries.empty())
      error(node.mark, "a step without any action", "remove it");
  }

  /// The crew slots that act under the name `entry.key`.
  std::vector<std::size_t> actor_slots(const SourceEntry& entry) {
    std::vector<std::size_t> slots;
    std::vector<std::string> actors;
    for (std::size_t i = 0; i < task_.crew.size(); ++i) {
      const CrewSlot& slot = task_.crew[i];
      if (!slot.worker) continue;
      if (slot.role == entry.key) slots.push_back(i);
      actors.push_back(slot.role);
    }
    if (!slots.empty()) return slots;
    if (state_.names.find(Section::kCarriers, entry.key)) {
      error(entry.mark, fmt::format("{} is a carrier and cannot act", in_quotes(entry.key)),
            "let its mover fetch and park it");
    } else {
      actors.erase(std::unique(actors.begin(), actors.end()), actors.end());
      error(entry.mark, fmt::format("{} is not in the crew", in_quotes(entry.key)),
            state_.problems.hint(entry.key, actors));
    }
    return slots;
  }

  using Actions = std::pair<std::vector<Action>, std::vector<SourceMark>>;

  Actions build_actions(const SourceNode& node) {
    Actions actions;
    const auto add = [&](const SourceNode& source) {
      if (auto action = build_action(source)) {
        actions.first.push_back(*action);
        actions.second.push_back(source.mark);
      }
    };
    if (node.is_mapping()) add(node);
    for (const SourceNode& item : node.items) add(item);
    return actions;
  }

  std::optional<Action> build_action(const SourceNode& node) {
    Action action;
    action.before = integer_or(node, "before", 0);
    action.after = integer_or(node, "after", 0);
    if (const SourceNode* go = node.find("go")) {
      const auto station = reference(state_, Section::kStations, *go, title_);
      if (!station) return std::nullopt;
      action.what = GoAction{StationId(*station)};
    } else if (const SourceNode* fetch = node.find("fetch")) {
      const auto slot = carrier_slot(*fetch);
      if (!slot) return std::nullopt;
      action.what = FetchAction{*slot};
    } else if (node.find("park") != nullptr) {
      return build_park(node, action);
    } else if (node.find("transfer") != nullptr) {
      return build_transfer(node, action);
    } else if (const SourceNode* operate = node.find("operate")) {
      const auto operation = reference(state_, Section::kOperations, *operate, title_);
      if (!operation) return std::nullopt;
      action.what = OperateAction{OperationId(*operation)};
    } else if (node.find("release") != nullptr) {
      action.what = ReleaseAction{};
    } else {
      return std::nullopt;  // what it does was reported as wrong
    }
    return action;
  }

  std::optional<Action> build_park(const SourceNode& node, Action action) {
    const auto slot = carrier_slot(*node.find("park"));
    ParkAction park;
    park.berth = reference_at<PlaceId>(state_, Section::kPlaces, node, "berth", title_);
    if (!slot) return std::nullopt;
    park.carrier_slot = *slot;
    action.what = park;
    return action;
  }

  std::optional<Action> build_transfer(const SourceNode& node, Action action) {
    const SourceNode& ends = *node.find("transfer");
    const auto source = endpoint(ends.items[0]);
    const auto destination = endpoint(ends.items[1]);
    if (!source || !destination) return std::nullopt;
    TransferAction transfer;
    transfer.source = *source;
    transfer.destination = *destination;
    transfer.takes = integer_or(node, "takes", transfer.takes);
    transfer.repeat = text_or(node, "repeat", "1") == "until_blocked"
                          ? TransferAction::kUntilBlocked
                          : integer_or(node, "repeat", 1);
    if (source->place == destination->place && source->slot == destination->slot) {
      error(ends.mark, fmt::format("a transfer from {} to itself", in_quotes(ends.items[0].text)),
            "write transfer: [FROM, TO]");
    }
    action.what = transfer;
    return action;
  }

  /// The carrier of the crew that `node` names; reports when it is not in the crew.
  std::optional<std::size_t> carrier_slot(const SourceNode& node) {
    std::vector<std::string> carriers;
    for (std::size_t i = 0; i < task_.crew.size(); ++i) {
      if (!task_.crew[i].carrier) continue;
      if (task_.crew[i].role == node.text) return i;
      carriers.push_back(task_.crew[i].role);
    }
    std::string hint = state_.problems.hint(node.text, carriers);
    if (hint.empty()) hint = fmt::format("add it to the crew: {}: empty", node.text);
    error(node.mark, fmt::format("there is no carrier {} in the crew", in_quotes(node.text)), hint);
    return std::nullopt;
  }

  std::optional<Endpoint> endpoint(const SourceNode& node) {
    if (state_.names.find(Section::kCarriers, node.text)) {
      const auto slot = carrier_slot(node);
      return slot ? std::optional(Endpoint{std::nullopt, *slot}) : std::nullopt;
    }
    if (const auto place = state_.names.find(Section::kPlaces, node.text)) {
      return Endpoint{PlaceId(*place), 0};
    }
    const auto known = [this] {
      std::vector<std::string> names = state_.names.names(Section::kPlaces);
      for (const CrewSlot& slot : task_.crew) {
        if (slot.carrier) names.push_back(slot.role);
      }
      return names;
    };
    error(node.mark,
          fmt::format("{} is neither a place nor the crew's carrier", in_quotes(node.text)),
          state_.problems.hint(node.text, known));
    return std::nullopt;
  }

  BuildState& state_;
  const SourceNode& node_;
  std::string title_;
  Task task_;
  TaskSource source_;
};

}  // namespace

void build_tasks(BuildState& state) {
  state.each(Section::kTasks, [&](std::int32_t id, const SourceNode& node) {
    TaskBuilder(state, id, node).build();
  });
}

}  // namespace linewright::loading
