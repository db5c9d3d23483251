#include <fmt/format.h>

#include <map>
#include <utility>

#include "build_state.hpp"
#include "task_actions.hpp"

namespace linewright::loading {
namespace {

/// Whether there can ever be a crew for the task.
class CrewCheck {
 public:
  CrewCheck(const BuildState& state, std::int32_t id)
      : state_(state), id_(id), task_(state.line().tasks[static_cast<std::size_t>(id)]) {}

  void run() {
    check_workers_suffice();
    for (const CrewSlot& slot : task_.crew) {
      if (slot.carrier) check_carrier(slot);
    }
  }

 private:
  [[nodiscard]] const SourceNode& node() const { return state_.names.node(Section::kTasks, id_); }
  [[nodiscard]] SourceMark mark_of_role(const std::string& role) const {
    const SourceNode* crew = node().find("crew");
    for (const SourceEntry& entry : crew->entries) {
      if (entry.key == role) return entry.mark;
    }
    return crew->mark;
  }
  void error(SourceMark mark, const std::string& message, std::string hint) {
    state_.problems.error(mark,
                          fmt::format("{}: {}", state_.names.title(Section::kTasks, id_), message),
                          std::move(hint));
  }

  void check_workers_suffice() {
    std::map<std::int32_t, std::int32_t> wanted;
    for (const CrewSlot& slot : task_.crew) {
      if (slot.worker) ++wanted[slot.worker->value];
    }
    for (const auto& [kind, count] : wanted) {
      const WorkerKind& worker = state_.line().worker_kinds[static_cast<std::size_t>(kind)];
      if (!state_.is_sound(Section::kWorkers, kind) || count <= worker.count.max) continue;
      error(mark_of_role(worker.name),
            fmt::format("the crew needs {} of {}, but there are at most {}", count,
                        in_quotes(worker.name), worker.count.max),
            "make 'count' of the worker larger or the crew smaller");
    }
  }

  void check_carrier(const CrewSlot& slot) {
    const CarrierKind& kind = state_.line().carrier_kinds[slot.carrier->index()];
    if (state_.is_sound(Section::kCarriers, slot.carrier->value) && kind.count.max < 1) {
      error(mark_of_role(slot.role),
            fmt::format("the crew needs a {}, but there are none", in_quotes(slot.role)),
            "make 'count' of the carrier larger");
    }
    if (slot.wanted == CarrierWanted::kBerth) check_berth(slot);
  }

  void check_berth(const CrewSlot& slot) {
    const auto id = slot.berth.value;
    const Place& place = state_.line().places[slot.berth.index()];
    if (!state_.is_sound(Section::kPlaces, id)) return;
    const SourceMark mark = mark_of_role(slot.role);
    if (!place.berth) {
      error(mark, fmt::format("place {} is no berth", in_quotes(place.name)),
            fmt::format("give the place carrier: {}, or ask for empty or any", slot.role));
    } else if (place.berth->carrier != *slot.carrier) {
      const std::string& other = state_.line().carrier_kinds[place.berth->carrier.index()].name;
      error(mark,
            fmt::format("berth {} is for {}, not for {}", in_quotes(place.name), in_quotes(other),
                        in_quotes(slot.role)),
            fmt::format("name a berth for {}", in_quotes(slot.role)));
    } else if (!somebody_parks(slot.berth)) {
      error(mark,
            fmt::format("no task ever parks a {} in berth {}", in_quotes(slot.role),
                        in_quotes(place.name)),
            fmt::format("add an action {{park: {}, berth: {}}} to a task", slot.role, place.name));
    }
  }

  [[nodiscard]] bool somebody_parks(PlaceId berth) const {
    const auto& tasks = state_.line().tasks;
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      // A task with problems of its own may well be the one.
      if (!state_.is_sound(Section::kTasks, static_cast<std::int32_t>(i))) return true;
      if (parks_in(tasks[i], berth)) return true;
    }
    return false;
  }

  const BuildState& state_;
  std::int32_t id_;
  const Task& task_;
};

}  // namespace

void check_crews(const BuildState& state) {
  for (std::size_t i = 0; i < state.line().tasks.size(); ++i) {
    const auto id = static_cast<std::int32_t>(i);
    if (state.is_sound(Section::kTasks, id)) CrewCheck(state, id).run();
  }
}

}  // namespace linewright::loading
