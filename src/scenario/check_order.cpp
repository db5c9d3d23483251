#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "build_state.hpp"
#include "linewright/scenario/values.hpp"
#include "task_actions.hpp"

namespace linewright::loading {
namespace {

/// Which places can ever hold a token when times, capacities and conditions are left out. A berth
/// holds what some carrier of its kind can hold, provided that a task parks one there.
class Reachability {
 public:
  explicit Reachability(const LineModel& line)
      : line_(line),
        filled_(line.places.size(), false),
        supplied_(line.places.size(), false),
        carried_(line.carrier_kinds.size(), false) {
    for (std::size_t i = 0; i < line.places.size(); ++i) {
      filled_[i] = line.places[i].initial.value(line.order.quantity) > 0;
    }
    find_parked();
    while (spread()) {
    }
  }

  [[nodiscard]] bool is_filled(PlaceId id) const {
    const Place& place = line_.places[id.index()];
    if (!place.berth) return filled_[id.index()];
    return is_served(id) && carried_[place.berth->carrier.index()];
  }

  /// Whether something can ever be added to what lies there at the start.
  [[nodiscard]] bool is_supplied(PlaceId id) const {
    return line_.places[id.index()].berth ? is_filled(id) : supplied_[id.index()];
  }

  /// A berth that no task parks a carrier in stays without one.
  [[nodiscard]] bool is_served(PlaceId id) const {
    return !line_.places[id.index()].berth ||
           std::find(parked_.begin(), parked_.end(), id) != parked_.end();
  }

 private:
  void find_parked() {
    for (const Task& task : line_.tasks) {
      for_each_action_of<ParkAction>(task, [this](const ParkAction& park) {
        if (park.berth) parked_.push_back(*park.berth);
      });
    }
  }

  /// True when something new was filled.
  bool spread() {
    bool changed = false;
    for (const Operation& operation : line_.operations) {
      const auto has = [this](const TokenFlow& flow) { return is_filled(flow.place); };
      const auto served = [this](const TokenFlow& flow) { return is_served(flow.place); };
      if (!std::all_of(operation.consumes.begin(), operation.consumes.end(), has)) continue;
      if (!std::all_of(operation.produces.begin(), operation.produces.end(), served)) continue;
      for (const TokenFlow& flow : operation.produces) changed |= fill(flow.place);
    }
    for (const Task& task : line_.tasks) {
      for_each_action_of<TransferAction>(
          task, [&](const TransferAction& transfer) { changed |= move(task, transfer); });
    }
    return changed;
  }

  bool move(const Task& task, const TransferAction& transfer) {
    const Endpoint& from = transfer.source;
    const bool available = from.place ? is_filled(*from.place) : carried(task, from.slot);
    if (!available) return false;
    if (transfer.destination.place) return fill(*transfer.destination.place);
    return set(carried_, task.crew[transfer.destination.slot].carrier->index());
  }

  [[nodiscard]] bool carried(const Task& task, std::size_t slot) const {
    return carried_[task.crew[slot].carrier->index()];
  }

  bool fill(PlaceId id) {
    const Place& place = line_.places[id.index()];
    if (place.berth) return set(carried_, place.berth->carrier.index());
    supplied_[id.index()] = true;
    return set(filled_, id.index());
  }

  static bool set(std::vector<bool>& flags, std::size_t index) {
    const bool is_new = !flags[index];
    flags[index] = true;
    return is_new;
  }

  const LineModel& line_;
  std::vector<bool> filled_;    ///< by place; berths: see carried_
  std::vector<bool> supplied_;  ///< by place: by an operation or a transfer
  std::vector<bool> carried_;   ///< by carrier kind: something can be in one
  std::vector<PlaceId> parked_;
};

/// Follows the first way that could have filled a place back to where it breaks off.
class Explanation {
 public:
  static constexpr int kMostLinks = 5;

  Explanation(const LineModel& line, const Reachability& reachable)
      : line_(line), reachable_(reachable), seen_(line.places.size(), false) {}

  [[nodiscard]] std::string why_empty(PlaceId id) {
    if (seen_[id.index()]) return fmt::format("{} waits for itself in a circle", named(id));
    seen_[id.index()] = true;
    ++links_;
    if (!reachable_.is_served(id)) return fmt::format("no task parks a carrier in {}", named(id));
    for (const Operation& operation : line_.operations) {
      const auto& made = operation.produces;
      if (std::any_of(made.begin(), made.end(),
                      [&](const TokenFlow& f) { return f.place == id; })) {
        return why_idle(operation);
      }
    }
    if (const auto source = source_of_transfer(id)) return why_not_moved(*source);
    return fmt::format("nothing ever puts anything into {}", named(id));
  }

 private:
  [[nodiscard]] std::string named(PlaceId id) const {
    return "place " + in_quotes(line_.places[id.index()].name);
  }

  std::string why_idle(const Operation& operation) {
    const bool is_named = links_ <= kMostLinks;
    std::string reason;
    for (const TokenFlow& flow : operation.consumes) {
      if (reason.empty() && !reachable_.is_filled(flow.place)) reason = why_empty(flow.place);
    }
    for (const TokenFlow& flow : operation.produces) {
      if (reason.empty() && !reachable_.is_served(flow.place)) reason = why_empty(flow.place);
    }
    if (!is_named) return reason;  // a chain that long is cut in the middle
    return fmt::format("operation {} never starts: {}", in_quotes(operation.name), reason);
  }

  struct Source {
    Source(Endpoint from, const Task& of) : endpoint(from), task(of) {}
    Endpoint endpoint;
    const Task& task;
  };

  /// Where some task takes the items from that it puts into `id`.
  [[nodiscard]] std::optional<Source> source_of_transfer(PlaceId id) const {
    for (const Task& task : line_.tasks) {
      std::optional<Source> source;
      for_each_action_of<TransferAction>(task, [&](const TransferAction& transfer) {
        if (transfer.destination.place == id) source.emplace(transfer.source, task);
      });
      if (source) return source;
    }
    return std::nullopt;
  }

  std::string why_not_moved(const Source& source) {
    if (source.endpoint.place) return why_empty(*source.endpoint.place);
    return fmt::format("task {} moves items out of {}, into which nothing is ever put",
                       in_quotes(source.task.name),
                       in_quotes(source.task.crew[source.endpoint.slot].role));
  }

  const LineModel& line_;
  const Reachability& reachable_;
  std::vector<bool> seen_;
  int links_ = 0;
};

bool has_default_goal(const SourceNode& root) {
  const SourceNode* order = root.find("order");
  return order != nullptr && order->find("done_when") == nullptr;
}

}  // namespace

void check_order(const BuildState& state) {
  if (!state.problems.none() || !has_default_goal(state.root)) return;
  const LineModel& line = state.line();
  const Place& place = line.places[line.order.finished_in.index()];
  const SourceNode& order = *state.root.find("order");
  const std::int32_t quantity = line.order.quantity;
  if (place.initial.value(quantity) >= quantity) return;
  const std::string name = in_quotes(place.name);
  if (place.capacity && *place.capacity < quantity) {
    state.problems.error(
        mark_of(order, "finished_in"),
        fmt::format("the order can never be finished: {} holds at most {}, but {} are ordered",
                    name, *place.capacity, quantity),
        "make the place's 'capacity' larger, or write 'done_when'");
    return;
  }
  const Reachability reachable(line);
  if (reachable.is_supplied(line.order.finished_in)) return;
  state.problems.error(mark_of(order, "finished_in"),
                       fmt::format("the order can never be finished: {}",
                                   Explanation(line, reachable).why_empty(line.order.finished_in)),
                       "follow the items from the first place to 'finished_in'");
}

}  // namespace linewright::loading
