#include "task_net.hpp"

#include <algorithm>

namespace linewright::bounds {

std::optional<StationId> station_of_berth(const LineModel& line, PlaceId berth) {
  std::optional<StationId> found;
  for (const Task& task : line.tasks) {
    for (const Step& step : task.steps) {
      for (const ActorSequence& sequence : step.sequences) {
        std::optional<StationId> stands;  // within this step: what is known for sure
        for (const Action& action : sequence.actions) {
          if (const auto* go = std::get_if<GoAction>(&action.what)) stands = go->station;
          if (std::holds_alternative<FetchAction>(action.what)) stands.reset();
          const auto* park = std::get_if<ParkAction>(&action.what);
          if (park == nullptr || park->berth != berth) continue;
          if (!stands || (found && *found != *stands)) return std::nullopt;
          found = stands;
        }
      }
    }
  }
  return found;
}

TaskNet::TaskNet(LineNet& net, TaskId task)
    : net_(net),
      task_(net.line.tasks[task.index()]),
      id_(task),
      events_(net.tasks[task.index()]),
      members_(task_.crew.size()) {
  events_.first = static_cast<int>(net.net.size());
  for (std::size_t slot = 0; slot < task_.crew.size(); ++slot) {
    const CrewSlot& crew = task_.crew[slot];
    if (crew.carrier && crew.wanted == CarrierWanted::kBerth)
      members_[slot].stands = station_of_berth(net.line, crew.berth);
    if (!crew.join_late) continue;
    members_[slot].joined = net_.net.add({.name = task_.name + " joined"});
    net_.net[members_[slot].joined].arcs.push_back({.from = events_.start});
  }
}

void TaskNet::build() {
  std::vector<int> last{events_.start};
  for (std::size_t step = 0; step < task_.steps.size(); ++step) {
    const int begin = net_.net.add({.name = task_.name + " step"});
    for (const int event : last) net_.net[begin].arcs.push_back({.from = event});
    last = {begin};
    events_.step_begin.push_back(begin);
    events_.actions.emplace_back();
    for (std::size_t s = 0; s < task_.steps[step].sequences.size(); ++s)
      add_sequence(step, s, last);
  }
  for (const int event : last) net_.net[events_.end].arcs.push_back({.from = event});
  events_.last = static_cast<int>(net_.net.size()) - 1;
}

void TaskNet::add_sequence(std::size_t step, std::size_t sequence, std::vector<int>& last) {
  const ActorSequence& acts = task_.steps[step].sequences[sequence];
  auto& actions = events_.actions[step].emplace_back();
  Member& member = members_[acts.slot];
  if (member.gone) return;
  int before = events_.step_begin[step];
  if (member.joined >= 0) {
    const int joined = net_.net.add({.name = task_.name + " joined"});
    net_.net[joined].arcs = {{.from = before}, {.from = member.joined}};
    before = joined;
  }
  for (std::size_t a = 0; a < acts.actions.size(); ++a) {
    actions.push_back({.begin = before});
    add_action(step, sequence, a);
    before = actions.back().end;
  }
  last.push_back(before);
}

void TaskNet::add_action(std::size_t step, std::size_t sequence, std::size_t a) {
  const std::size_t slot = task_.steps[step].sequences[sequence].slot;
  const Action& action = task_.steps[step].sequences[sequence].actions[a];
  const int begin = events_.actions[step][sequence][a].begin;
  members_[slot].settling += action.before + action.after;
  Event end{.name = task_.name};
  end.arcs.push_back({.from = begin, .lag = action.before + action.after});
  if (const auto* to = std::get_if<GoAction>(&action.what)) {
    go(action, slot, to->station, end);
  } else if (const auto* fetched = std::get_if<FetchAction>(&action.what)) {
    fetch(action, slot, fetched->carrier_slot, end);
  } else if (const auto* parks = std::get_if<ParkAction>(&action.what)) {
    park(action, slot, *parks, end);
  } else if (std::holds_alternative<TransferAction>(action.what)) {
    transfer(step, sequence, a, end);
  } else if (const auto* operates = std::get_if<OperateAction>(&action.what)) {
    operate(action, *operates, end);
  } else {
    members_[slot].gone = true;
  }
  events_.actions[step][sequence][a].end = net_.net.add(std::move(end));
}

void TaskNet::go(const Action& action, std::size_t slot, StationId to, Event& end) {
  const WorkerKindId kind = *task_.crew[slot].worker;
  Member& member = members_[slot];
  const Tick way = member.stands ? net_.ways.between(kind, *member.stands, to) : 0;
  const Tick least =
      std::max(way >= kNever ? 0 : way, net_.line.worker_kinds[kind.index()].min_leg_ticks);
  end.arcs[0].lag = action.before + least + action.after;
  Tick reach = net_.ways.reach(kind, to);
  if (member.holds && task_.crew[*member.holds].wanted != CarrierWanted::kBerth) {
    reach = std::max(reach, net_.ways.bring_carrier(kind, *task_.crew[*member.holds].carrier, to));
  }
  // Who rests may be under way already when it is called: nothing is sure but the way.
  const bool rests = !net_.line.worker_kinds[kind.index()].rest.empty();
  end.least = reach >= kNever ? kNever : reach + (rests ? 0 : member.settling);
  member.stands = to;
  if (member.holds) members_[*member.holds].stands = to;
}

void TaskNet::fetch(const Action& action, std::size_t slot, std::size_t carrier, Event& end) {
  const WorkerKindId kind = *task_.crew[slot].worker;
  Member& member = members_[slot];
  const std::optional<StationId> to = members_[carrier].stands;
  const Tick way = member.stands && to ? net_.ways.between(kind, *member.stands, *to) : 0;
  const Tick least =
      std::max(way >= kNever ? 0 : way, net_.line.worker_kinds[kind.index()].min_leg_ticks);
  end.arcs[0].lag = action.before + least + action.after;
  const Tick reach =
      to ? net_.ways.reach(kind, *to) : net_.ways.reach_carrier(kind, *task_.crew[carrier].carrier);
  const bool rests = !net_.line.worker_kinds[kind.index()].rest.empty();
  end.least = reach >= kNever ? kNever : reach + (rests ? 0 : member.settling);
  member.stands = to;
  member.holds = carrier;
}

void TaskNet::park(const Action& action, std::size_t slot, const ParkAction& what,
                   const Event& end) {
  Member& member = members_[slot];
  member.holds.reset();
  if (!what.berth) return;
  const Place& place = net_.line.places[what.berth->index()];
  int event = events_.start;
  if (place.berth->occupied == BerthOccupied::kOnArrival) {
    event = net_.net.add({.name = task_.name + " parks"});
    net_.net[event].arcs.push_back({.from = end.arcs[0].from, .lag = action.before});
  }
  net_.net[net_.parked[what.berth->index()]].sources.push_back({event, 1});
}

void TaskNet::operate(const Action& action, const OperateAction& what, Event& end) {
  const std::size_t o = what.operation.index();
  const Operation& operation = net_.line.operations[o];
  const int begin = end.arcs[0].from;
  const int ready = net_.net.add({.name = task_.name + " is ready"});
  net_.net[ready].arcs.push_back({.from = begin, .lag = action.before});
  net_.net[net_.tries[o]].sources.push_back({ready, 1});
  end.arcs[0].lag += operation.takes + least_travel(net_.line, operation);
  end.arcs.push_back({.from = net_.ends[o], .lag = action.after});
}

std::optional<Tick> longest_lag(const EventNet& net, const TaskEvents& task, int from, int to,
                                const std::map<int, Tick>& more) {
  // Within a task every rule leads from an earlier event to one that was made later; only its end
  // was made first.
  const int last = to == task.end ? task.last : to;
  std::vector<std::optional<Tick>> longest(static_cast<std::size_t>(last - task.first + 1));
  const auto known = [&](int event) -> std::optional<Tick> {
    if (event == from) return 0;
    if (event < task.first || event > last) return std::nullopt;
    return longest[static_cast<std::size_t>(event - task.first)];
  };
  const auto longest_into = [&](int event) {
    std::optional<Tick> best;
    const auto added = more.find(event);
    for (const Arc& arc : net[event].arcs) {
      const bool plain = arc.times == 1 && arc.plus == 0 && arc.divide == 1;
      if (!plain) continue;
      const auto before = known(arc.from);
      if (!before) continue;
      const Tick lag = arc.lag + (added == more.end() ? 0 : added->second);
      best = std::max(best.value_or(0), *before + lag);
    }
    return best;
  };
  for (int event = task.first; event <= last; ++event)
    longest[static_cast<std::size_t>(event - task.first)] = longest_into(event);
  if (to == from) return 0;
  return to == task.end ? longest_into(to) : known(to);
}

}  // namespace linewright::bounds
